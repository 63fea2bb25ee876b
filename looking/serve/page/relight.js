// Groups of lights as sliders: radiance is the sum of what they bring, so the picture is mixed here, at once.
import {value} from './pictures.js';

const $ = id => document.getElementById(id);
const off = -8, brightest = 4;  // stops
const linear = v => v <= .04045 ? v / 12.92 : ((v + .055) / 1.055) ** 2.4;
const in_words = v => Number(v.toPrecision(3)).toString();

export class Relight {
  #groups = [];          // {name, stops, colour: '#rrggbb', changes}
  #mixed = new Map();    // by frame and size: {made_of, picture}
  #version = 0;

  constructor(on_change) {
    this.on_change = on_change;
    $('relit_copy').onclick = () => navigator.clipboard?.writeText($('relit').textContent);
    $('unlit').onclick = () => { this.#groups.forEach(g => { g.stops = 0, g.colour = '#ffffff'; }), this.#fill(), this.#changed(); };
  }

  show(run) {
    const names = (run.groups ?? []).filter(name => run.outputs.some(o => o.name === `light_${name}`));
    const before = new Map(this.#groups.map(g => [g.name, g]));
    this.run = run;
    this.is_whole = names.length === (run.groups ?? []).length;
    this.#groups = names.map(name => before.get(name) ?? {name, stops: 0, colour: '#ffffff'});
    this.#mixed.clear();
    $('lights').hidden = (run.groups ?? []).length < 2;
    $('lights_hint').hidden = names.length > 0, $('lights_mix').hidden = names.length === 0;
    this.#fill(), this.#say();
  }

  is_on() { return this.#groups.some(g => g.stops !== 0 || g.colour !== '#ffffff'); }
  // What has to be looked at besides radiance.
  outputs() { return this.is_on() ? this.#groups.map(g => `light_${g.name}`) : []; }

  // `picture_of(output)`: of the frame and size that are looked at, or null. Radiance until all are there.
  mix(radiance, picture_of) {
    if (!radiance || !this.is_on()) return radiance;
    const parts = this.#groups.map(g => picture_of(`light_${g.name}`));
    const fit = parts.every(p => p && p.width === radiance.width && p.height === radiance.height && p.coarse === radiance.coarse);
    if (!fit) return radiance;
    const name = `${radiance.frame} ${radiance.width}`, known = this.#mixed.get(name);
    const made_of = [radiance.version, ...parts.map(p => p.version), this.#version].join(' ');
    if (known?.made_of === made_of) return known.picture;
    const picture = this.#sum(radiance, parts);
    this.#mixed.set(name, {made_of, picture});
    return picture;
  }

  // If a group is missing, the others change the whole by what they differ.
  #sum(radiance, parts) {
    const {width, height} = radiance, data = new Float32Array(3 * width * height);
    const factors = this.#groups.map(g => this.#factor(g).map(f => this.is_whole ? f : f - 1));
    for (let y = 0, at = 0; y < height; ++y)
      for (let x = 0; x < width; ++x, at += 3) {
        if (!this.is_whole) data.set(value(radiance, x, y), at);
        parts.forEach((part, g) => {
          const light = value(part, x, y);
          for (let c = 0; c < 3; ++c) data[at + c] += factors[g][c] * light[c];
        });
      }
    return {...radiance, bytes: 4, data, is_smooth: true, range: undefined};
  }

  #factor({stops, colour}) {
    const strength = stops <= off ? 0 : 2 ** stops;
    return [1, 3, 5].map(i => strength * linear(parseInt(colour.slice(i, i + 2), 16) / 255));
  }

  #fill() {
    $('sliders').replaceChildren(...this.#groups.map(group => {
      const row = document.createElement('div'), label = document.createElement('label'), said = document.createElement('output');
      const stops = document.createElement('input'), colour = document.createElement('input');
      const say = () => { said.textContent = group.stops <= off ? 'off' : `${group.stops > 0 ? '+' : ''}${group.stops.toFixed(2)} stops`; };
      Object.assign(stops, {type: 'range', min: off, max: brightest, step: .25, value: group.stops});
      Object.assign(colour, {type: 'color', value: group.colour});
      colour.setAttribute('aria-label', `colour of ${group.name}`);
      stops.oninput = () => { group.stops = stops.valueAsNumber, say(), this.#changed(); };
      colour.oninput = () => { group.colour = colour.value, this.#changed(); };
      say(), label.append(group.name, ' ', said, stops), row.append(label, colour), row.className = 'light';
      return row;
    }));
  }

  #changed() { ++this.#version, this.#say(), this.on_change(); }

  // The command line that makes the same of the files.
  #say() {
    const words = this.#groups.filter(g => g.stops !== 0 || g.colour !== '#ffffff').map(g => {
      const strength = g.stops <= off ? '0' : in_words(2 ** g.stops), colour = this.#factor({...g, stops: 0}).map(in_words);
      return `'${[g.name, ...g.stops !== 0 ? [strength] : [], ...g.colour !== '#ffffff' ? [`[${colour.join(' ')}]`] : []].join(' ')}'`;
    });
    const images = this.run?.images ?? [];
    const target = images.length > 1 ? 'relit.####.exr' : 'relit.exr';
    $('relit').textContent = words.length > 0 ? `dspm --relight ${in_one_word(images)} ${words.join(' ')} -o ${target}` : '\u00a0';
    $('unlit').disabled = $('relit_copy').disabled = words.length === 0;
  }
}

// What a shell takes for all of these names.
function in_one_word(names) {
  if (names.length < 2) return names[0] ?? '';
  const [first] = names, shortest = Math.min(...names.map(n => n.length));
  let start = 0, end = 0;
  while (start < shortest && names.every(n => n[start] === first[start])) ++start;
  while (end < shortest - start && names.every(n => n.at(-1 - end) === first.at(-1 - end))) ++end;
  return `${first.slice(0, start)}*${first.slice(first.length - end)}`;
}
