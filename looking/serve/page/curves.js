// The curves of --view, as in output/view_curve.cpp: from linear light to what a screen shows, in 0..1. For the 2D canvas as
// functions, for WebGL as GLSL of the same.

const clamped = v => Math.min(Math.max(v, 0), 1);
export const srgb = v => v <= .0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - .055;

// [Hable 2010]
const film_at = x => (x * (.15 * x + .05) + .004) / (x * (.15 * x + .5) + .06) - .02 / .3;
const filmic = v => srgb(clamped(film_at(2 * Math.min(v, 1e4)) / film_at(11.2)));

// [Sobotka]
const inset = [[.842479062253094, .0784335999999992, .0792237451477643], [.0423282422610123, .878468636469772, .0791661274605434],
               [.0423756549057051, .0784336, .879142973793104]];
const outset = [[1.19687900512017, -.0980208811401368, -.0990297440797205], [-.0528968517574562, 1.15190312990417, -.0989611768448433],
                [-.0529716355144438, -.0980434501171241, 1.15107367264116]];
const times = (m, v) => m.map(row => row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
const below = 10, above = 6.5, pivot = below / (below + above);
function bent(x) {
  const power = x < pivot ? 3 : 3.25, reach = x < pivot ? pivot : 1 - pivot;
  const bend = ((4 * reach) ** power - 1) / reach ** power;
  return .5 + 2 * (x - pivot) / (1 + bend * Math.abs(x - pivot) ** power) ** (1 / power);
}
// [Wrensch 2023] Looks: slope, power, saturation.
const looks = [[[1, 1, 1], 1, 1], [[1, 1, 1], 1.35, 1.4], [[1, .9, .5], .8, .8]];
function looking(rgb, [slope, power, saturation]) {
  const c = rgb.map((v, i) => Math.max(v * slope[i], 0) ** power), grey = .2126 * c[0] + .7152 * c[1] + .0722 * c[2];
  return c.map(v => grey + saturation * (v - grey));
}
const agx = look => rgb => times(outset, looking(times(inset, rgb).map(
  v => bent(clamped((Math.log2(Math.max(v / .18, 1e-10)) + below) / (below + above)))), looks[look])).map(clamped);

// [Khronos PBR Neutral]
function neutral(rgb) {
  const least = Math.min(...rgb), off = least < .08 ? least - 6.25 * least * least : .04, c = rgb.map(v => v - off);
  const peak = Math.max(...c), start = .76;
  if (peak < start) return c;
  const lower = 1 - (1 - start) ** 2 / (peak + 1 - 2 * start), kept = 1 / (.15 * (peak - lower) + 1);
  return c.map(v => kept * v * lower / peak + (1 - kept) * lower);
}

// [Hill 2016]
const aces_in = [[.59719, .35458, .04823], [.076, .90834, .01566], [.0284, .13383, .83777]];
const aces_out = [[1.60475, -.53108, -.07367], [-.10208, 1.10813, -.00605], [-.00327, -.07276, 1.07602]];
const aces = rgb => times(aces_out, times(aces_in, rgb).map(
  v => (v * (v + .0245786) - .000090537) / (v * (.983729 * v + .432951) + .238081)));

const on_screen = curve => rgb => curve(rgb.map(v => Math.min(v, 1e6))).map(v => srgb(clamped(v)));

// In the order of their numbers, which is that of the page's list.
export const curves = [
  {name: 'agx', shows: agx(0)},
  {name: 'agx-punchy', shows: agx(1)},
  {name: 'agx-golden', shows: agx(2)},
  {name: 'neutral', shows: on_screen(neutral)},
  {name: 'aces', shows: on_screen(aces)},
  {name: 'filmic', shows: rgb => rgb.map(filmic)},
  {name: 'standard', shows: on_screen(rgb => rgb)},
  {name: 'raw', shows: rgb => rgb.map(clamped)},
];

const columns = m => `mat3(${[0, 1, 2].map(c => m.map(row => row[c]).join(',')).join(',')})`;
export const curves_glsl = `
vec3 srgb(vec3 v) { return mix(1.055 * pow(v, vec3(1. / 2.4)) - .055, 12.92 * v, vec3(lessThanEqual(v, vec3(.0031308)))); }
vec3 film_at(vec3 x) { return (x * (.15 * x + .05) + .004) / (x * (.15 * x + .5) + .06) - .02 / .3; }
float bent(float x) {
  const float pivot = float(${pivot});
  float power = x < pivot ? 3. : 3.25, reach = x < pivot ? pivot : 1. - pivot;
  float bend = (pow(4. * reach, power) - 1.) / pow(reach, power);
  return .5 + 2. * (x - pivot) / pow(1. + bend * pow(abs(x - pivot), power), 1. / power);
}
vec3 looking(vec3 v, vec3 slope, float power, float saturation) {
  v = pow(max(v * slope, 0.), vec3(power));
  return mix(vec3(dot(v, vec3(.2126, .7152, .0722))), v, saturation);
}
vec3 agx(vec3 v, int look) {
  v = log2(max(${columns(inset)} * v / .18, 1e-10)) / ${below + above} + float(${pivot});
  v = clamp(v, 0., 1.);
  v = vec3(bent(v.r), bent(v.g), bent(v.b));
${[1, 2].map(i => `  if (look == ${i}) v = looking(v, vec3(${looks[i][0]}), float(${looks[i][1]}), float(${looks[i][2]}));`).join('\n')}
  return clamp(${columns(outset)} * v, 0., 1.);
}
vec3 neutral(vec3 v) {
  float least = min(v.r, min(v.g, v.b));
  v -= least < .08 ? least - 6.25 * least * least : .04;
  float peak = max(v.r, max(v.g, v.b));
  if (peak < .76) return v;
  float lower = 1. - .0576 / (peak - .52);
  return mix(vec3(lower), v * lower / peak, 1. / (.15 * (peak - lower) + 1.));
}
vec3 aces(vec3 v) {
  v = ${columns(aces_in)} * v;
  return ${columns(aces_out)} * ((v * (v + .0245786) - .000090537) / (v * (.983729 * v + .432951) + .238081));
}
vec3 curved(vec3 v, int curve) {
  v = min(v, 1e6);
  if (curve <= 2) return agx(v, curve);
  if (curve == 7) return clamp(v, 0., 1.);
  if (curve == 3) v = neutral(v);
  if (curve == 4) v = aces(v);
  if (curve == 5) v = film_at(2. * min(v, 1e4)) / film_at(vec3(11.2));
  return srgb(clamp(v, 0., 1.));
}`;
