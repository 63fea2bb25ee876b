// Pictures from the server: one request waits for whatever is looked at and has changed.

const plane_bytes = async packed => new Uint8Array(await new Response(
  new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'))).arrayBuffer());

// The reverse of packed() in picture.cpp.
function unpacked(planes, picture) {
  const {channels, bytes} = picture, count = picture.width * picture.height;
  const values = bytes === 2 ? new Uint16Array(count * channels) : new Uint32Array(count * channels);
  for (let c = 0, at = 0; c < channels; ++c, at += count * bytes) {
    let before = 0;
    for (let i = 0; i < count; ++i) {
      let difference = 0;
      for (let b = 0; b < bytes; ++b) difference = difference << 8 | planes[at + b * count + i];
      before = bytes === 2 ? before + difference & 0xffff : before + difference | 0;
      values[i * channels + c] = before;
    }
  }
  return bytes === 2 ? values : new Float32Array(values.buffer);
}

export function half(bits) {
  const exponent = bits >> 10 & 31, fraction = bits & 1023, sign = bits & 0x8000 ? -1 : 1;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15));
}

// [r g b], or as many channels as there are.
export function value(picture, x, y) {
  const first = (y * picture.width + x) * picture.channels, result = [];
  for (let c = 0; c < picture.channels; ++c)
    result.push(picture.bytes === 2 ? half(picture.data[first + c]) : picture.data[first + c]);
  return result;
}

// Smallest and largest finite value.
export function range(picture) {
  if (picture.range) return picture.range;
  let low = Infinity, high = -Infinity;
  for (const bits of picture.data) {
    const v = picture.bytes === 2 ? half(bits) : bits;
    if (Number.isFinite(v)) low = Math.min(low, v), high = Math.max(high, v);
  }
  return picture.range = low < high ? [low, high] : [0, 1];
}

async function parsed(buffer) {
  const bytes = new Uint8Array(buffer), text = new TextDecoder(), pictures = [];
  for (let at = 0; at < bytes.length;) {
    const end = bytes.indexOf(10, at), words = text.decode(bytes.subarray(at, end)).split(' ');
    const [frame, , halvings, version, width, height, channels, size, iterations, coarse, run, length] = words.map(Number);
    const picture = {frame, output: words[1], halvings, version, width, height, channels, bytes: size, iterations,
                     coarse: coarse === 1, run};
    picture.data = unpacked(await plane_bytes(bytes.subarray(end + 1, end + 1 + length)), picture);
    pictures.push(picture);
    at = end + 1 + length;
  }
  return pictures;
}

const key = (frame, output) => `${frame} ${output}`;

export class Pictures {
  #viewer = Math.floor(Math.random() * 2 ** 48);
  #sizes = new Map();  // by frame and output: those of all sizes, by halvings
  #wishes = [];
  #abort = null;

  constructor(on_new) { this.on_new = on_new, this.bytes_received = 0, this.#run(); }

  look(wishes) {
    if (JSON.stringify(wishes) === JSON.stringify(this.#wishes)) return;
    this.#wishes = wishes;
    this.#abort?.abort();
  }

  // In the wanted size, else in the nearest; the newest run's.
  best(frame, output, halvings) {
    const sizes = this.#sizes.get(key(frame, output));
    if (!sizes) return null;
    let best = null;
    for (const picture of sizes.values()) if (!best || rank(picture, halvings) < rank(best, halvings)) best = picture;
    return best;
  }

  forget(frames) {
    for (const [name, sizes] of this.#sizes)
      if (Number(name.split(' ')[0]) >= frames) this.#sizes.delete(name);
  }

  #line({frame, output, halvings}) {
    const sizes = this.#sizes.get(key(frame, output)) ?? new Map();
    let other = 0;
    for (const picture of sizes.values()) other = Math.max(other, picture.version);
    return `${frame} ${output} ${halvings} ${sizes.get(halvings)?.version ?? 0} ${other}\n`;
  }

  #add(picture) {
    const name = key(picture.frame, picture.output);
    if (!this.#sizes.has(name)) this.#sizes.set(name, new Map());
    const sizes = this.#sizes.get(name);
    for (const [halvings, old] of sizes)  // sizes that nobody looks at any longer
      if (old.version < picture.version && old.iterations !== picture.iterations && halvings !== picture.halvings &&
          !this.#wishes.some(w => w.frame === old.frame && w.output === old.output && w.halvings === halvings))
        sizes.delete(halvings);
    sizes.set(picture.halvings, picture);
  }

  async #run() {
    for (;;) {
      this.#abort = new AbortController();
      if (this.#wishes.length === 0 || document.hidden) { await wait(100); continue; }
      try {
        const body = `${this.#viewer}\n${this.#wishes.map(w => this.#line(w)).join('')}`;
        const response = await fetch('pictures', {method: 'POST', body, signal: this.#abort.signal});
        if (!response.ok) { await wait(1000); continue; }
        const buffer = await response.arrayBuffer();
        this.bytes_received += buffer.byteLength;
        const pictures = await parsed(buffer);
        pictures.forEach(p => this.#add(p));
        if (pictures.length > 0) this.on_new(pictures);
      } catch (error) {
        if (error.name !== 'AbortError') await wait(1000);
      }
    }
  }
}

const wait = milliseconds => new Promise(done => setTimeout(done, milliseconds));
const rank = (picture, halvings) => Math.abs(picture.halvings - halvings);
