// The estimated relative error of pictures, from how they differ from earlier ones of themselves.
import {value} from './pictures.js';

const luminance = ([r, g, b]) => .2126 * r + .7152 * g + .0722 * b;

export class Errors {
  #earlier = new Map();  // by frame and size: the picture to compare with
  #known = new WeakMap();

  // To be called with every picture of radiance that comes.
  add(picture) {
    if (picture.output !== 'radiance') return;
    const name = `${picture.frame} ${picture.width}`, earlier = this.#earlier.get(name);
    if (earlier?.run !== picture.run) this.#earlier.set(name, picture);
    else if (picture.iterations > earlier.iterations) {
      this.#estimate(picture, earlier);
      if (picture.iterations >= 4 * earlier.iterations) this.#earlier.set(name, picture);
    }
  }

  // Null: there is no earlier one.
  of(picture) { return picture && (this.#known.get(picture) ?? null); }

  // E_N, the mean of N iterations, has the variance v / N, and E_N - E_M has v / M - v / N: so the difference times
  // sqrt(M / (N - M)) is as large as the error of E_N. Root mean squares of 5 x 5 pixels, as one alone tells little.
  #estimate(now, before) {
    const {width, height} = now, scale = Math.sqrt(before.iterations / (now.iterations - before.iterations));
    const square = new Float32Array(width * height), light = new Float32Array(width * height);
    for (let y = 0, i = 0; y < height; ++y)
      for (let x = 0; x < width; ++x, ++i) {
        light[i] = luminance(value(now, x, y));
        square[i] = (scale * (light[i] - luminance(value(before, x, y)))) ** 2;
      }
    const squares = blurred(square, width, height), lights = blurred(light, width, height);
    const data = squares.map((s, i) => lights[i] > 0 ? Math.sqrt(s) / lights[i] : 0);
    const high = data.slice().sort()[Math.floor(.99 * (data.length - 1))];
    this.#known.set(now, {frame: now.frame, output: 'error', width, height, channels: 1, bytes: 4, data,
      iterations: now.iterations, coarse: now.coarse, version: now.version, range: [0, high > 0 ? high : 1]});
  }
}

function blurred(values, width, height) {
  const along = (source, count, lines, step, next) => {
    const result = new Float32Array(source.length);
    for (let line = 0; line < lines; ++line)
      for (let i = 0; i < count; ++i) {
        let sum = 0, n = 0;
        for (let k = Math.max(i - 2, 0); k <= Math.min(i + 2, count - 1); ++k, ++n) sum += source[line * next + k * step];
        result[line * next + i * step] = sum / n;
      }
    return result;
  };
  return along(along(values, width, height, 1, width), height, width, width, 1);
}
