// From values to what the screen shows: for the 2D canvas here, for WebGL as GLSL of the same functions.
import {curves, curves_glsl, srgb} from './curves.js';

export const false_colour = curves.length;  // among the numbers of curves
export const kinds = {radiance: 0, direction: 1, ranged: 2, id: 3, plain: 4};

export function kind_of(output) {
  if (output.name === 'radiance' || output.is_radiance) return kinds.radiance;
  if (output.is_id) return kinds.id;
  if (output.name === 'N') return kinds.direction;
  return output.name === 'albedo' || output.name === 'uv' ? kinds.plain : kinds.ranged;
}

const stops = [[.05, .03, .2], [.15, .25, .9], [.0, .75, .8], [.2, .75, .2], [.95, .85, .1], [.9, .2, .1], [1, .9, .9]];
export const lowest_stop = -6, highest_stop = 6;  // of false colour, around a grey of 0.18

export function ramp(t) {
  const at = Math.min(Math.max(t, 0), 1) * (stops.length - 1), i = Math.min(Math.floor(at), stops.length - 2);
  return stops[i].map((low, c) => low + (stops[i + 1][c] - low) * (at - i));
}

const clamped = v => Math.min(Math.max(v, 0), 1);
const luminance = ([r, g, b]) => .2126 * r + .7152 * g + .0722 * b;

const hash_colour = id => {
  const bits = new Uint32Array(new Float32Array([id]).buffer)[0];
  return [bits & 255, bits >>> 8 & 255, bits >>> 16 & 255].map(v => bits === 0 ? 0 : .15 + .85 * v / 255);
};

// sRGB in 0..1.
export function shown(values, view) {
  if (view.kind === kinds.id) return hash_colour(values[0]);
  const rgb = values.length === 3 ? values : [values[0], values[1] ?? values[0], values.length === 2 ? 0 : values[0]];
  if (view.kind === kinds.direction) return rgb.map(v => clamped(v * .5 + .5));
  if (view.kind === kinds.plain) return rgb.map(v => srgb(clamped(v)));
  if (view.kind === kinds.ranged) {
    const scaled = rgb.map(v => clamped((v - view.range[0]) / (view.range[1] - view.range[0])));
    return values.length === 1 ? ramp(scaled[0]) : scaled;
  }
  const exposed = rgb.map(v => v > 0 ? v * 2 ** view.exposure : 0);
  if (view.tone === false_colour)
    return ramp((Math.log2(luminance(exposed) / .18) - lowest_stop) / (highest_stop - lowest_stop));
  return curves[view.tone].shows(exposed);
}

export const glsl = `${curves_glsl}
vec3 ramp(float t) {
  const vec3 stops[7] = vec3[7](${stops.map(s => `vec3(${s.map(v => v.toFixed(2)).join(',')})`).join(',')});
  float at = clamp(t, 0., 1.) * 6.; int i = min(int(at), 5);
  return mix(stops[i], stops[i + 1], at - float(i));
}
vec3 hash_colour(float id) {
  uint bits = floatBitsToUint(id);
  return bits == 0u ? vec3(0) : .15 + .85 * vec3(bits & 255u, bits >> 8 & 255u, bits >> 16 & 255u) / 255.;
}
vec3 shown(vec3 v, int kind, int tone, int channels, float exposure, vec2 range) {
  if (kind == 3) return hash_colour(v.r);
  if (channels == 1) v = v.rrr;
  if (kind == 1) return clamp(v * .5 + .5, 0., 1.);
  if (kind == 4) return srgb(clamp(v, 0., 1.));
  if (kind == 2) {
    v = clamp((v - range.x) / (range.y - range.x), 0., 1.);
    return channels == 1 ? ramp(v.r) : v;
  }
  v = vec3(v.r > 0. ? v.r : 0., v.g > 0. ? v.g : 0., v.b > 0. ? v.b : 0.) * exp2(exposure);
  if (tone == ${false_colour}) return ramp((log2(max(dot(v, vec3(.2126, .7152, .0722)), 1e-30) / .18) - (${lowest_stop}.)) / ${highest_stop - lowest_stop}.);
  return curved(v, tone);
}`;
