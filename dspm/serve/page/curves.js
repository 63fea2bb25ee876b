// The curves of --view, as in output/view.cpp: from linear light to what a screen shows, in 0..1. For the 2D canvas as
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
const agx = rgb => times(outset, times(inset, rgb.map(v => Math.min(v, 1e6))).map(
  v => bent(clamped((Math.log2(Math.max(v / .18, 1e-10)) + below) / (below + above))))).map(clamped);

// A fit of the ACES output transform. [Narkowicz, "ACES filmic tone mapping curve", 2016]
const aces = v => srgb(clamped(v * (2.51 * v + .03) / (v * (2.43 * v + .59) + .14)));

// In the order of their numbers.
export const curves = [
  {name: 'agx', shows: agx},
  {name: 'standard', shows: rgb => rgb.map(v => srgb(clamped(v)))},
  {name: 'filmic', shows: rgb => rgb.map(filmic)},
  {name: 'raw', shows: rgb => rgb.map(clamped)},
  {name: 'aces', shows: rgb => rgb.map(aces)},
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
vec3 agx(vec3 v) {
  v = log2(max(${columns(inset)} * min(v, 1e6) / .18, 1e-10)) / ${below + above} + float(${pivot});
  v = clamp(v, 0., 1.);
  return clamp(${columns(outset)} * vec3(bent(v.r), bent(v.g), bent(v.b)), 0., 1.);
}
vec3 curved(vec3 v, int curve) {
  if (curve == 0) return agx(v);
  if (curve == 3) return clamp(v, 0., 1.);
  if (curve == 2) v = film_at(2. * min(v, 1e4)) / film_at(vec3(11.2));
  if (curve == 4) v = v * (2.51 * v + .03) / (v * (2.43 * v + .59) + .14);
  return srgb(clamp(v, 0., 1.));
}`;
