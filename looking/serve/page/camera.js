// The camera by mouse: the page tells dspm where it is to stand, and says so in the scene's language.
import {order} from './control.js';

const $ = id => document.getElementById(id);
const add = (a, b, s = 1) => a.map((v, i) => v + s * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = v => v.map(c => c / (Math.hypot(...v) || 1));
const in_words = v => v.map(c => Number(c.toPrecision(5)).toString()).join(' ');

function turned(v, axis, angle) {  // Rodrigues' rotation
  const c = Math.cos(angle), s = Math.sin(angle), k = dot(axis, v) * (1 - c), x = cross(axis, v);
  return v.map((value, i) => value * c + x[i] * s + axis[i] * k);
}

const radians_per_pixel = .005;

export class Camera {
  is_on = false;
  #place = null;      // {eye, target, up} that viewers chose; null: where the scene says
  #is_unsent = false;
  #is_sending = false;
  #settled = 0;       // when the run follows what was sent last

  constructor() {
    $('undo').onclick = () => { this.#forget(), order('camera', ''); };
    $('copy').onclick = () => navigator.clipboard?.writeText(this.text());
    $('move').onclick = () => this.toggle();
  }

  toggle() {
    if ($('move').disabled) return;
    this.is_on = !this.is_on;
    $('move').setAttribute('aria-pressed', this.is_on);
    this.#show();
  }

  // The frame that is looked at; null: none.
  show(run, frame) {
    this.run = run, this.frame = frame;
    $('move').disabled = !frame?.eye && !this.is_on;
    const is_elsewhere = this.#place && frame?.eye &&
      Math.hypot(...add(frame.eye, this.#place.eye, -1)) > 1e-3 * Math.hypot(...add(frame.eye, this.#place.target, -1));
    if (is_elsewhere && !this.#is_unsent && performance.now() > this.#settled) this.#forget();  // the scene was edited
    this.#show();
  }

  orbit(dx, dy) {
    this.#change(({eye, target, up}) => {
      const back = add(eye, target, -1), axis = unit(up), sideways = (this.frame.mirrors ? -1 : 1) * dx * radians_per_pixel;
      const around = turned(back, axis, sideways), right = unit(cross(around, axis));
      const higher = turned(around, right, dy * radians_per_pixel);
      const is_over_the_top = Math.abs(dot(unit(higher), axis)) > .995;
      return {eye: add(target, is_over_the_top ? around : higher), target, up};
    });
  }

  // By pixels of a picture of that height, at the target.
  pan(dx, dy, height) {
    this.#change(({eye, target, up}) => {
      const forward = add(target, eye, -1), size = Math.hypot(...forward) / height;
      const right = unit(cross(unit(up), forward)), above = cross(unit(forward), right);
      const shift = add(right.map(v => v * (this.frame.mirrors ? dx : -dx) * size), above, dy * size);
      return {eye: add(eye, shift), target: add(target, shift), up};
    });
  }

  dolly(factor) {
    this.#change(({eye, target, up}) => ({eye: add(target, add(eye, target, -1), factor), target, up}));
  }

  text() {
    const place = this.#place ?? this.#of_frame();
    if (!place) return '';
    const look_at = `LookAt ${in_words(place.eye)}  ${in_words(place.target)}  ${in_words(place.up)}`;
    return this.run.moments.length > 1 ? `${look_at}\nKeyframe ${this.frame.moment} ${look_at}` : look_at;
  }

  // It turns around what it sees at the distance of the scene's middle.
  #of_frame() {
    if (!this.frame?.eye) return null;
    const {eye, forward, up} = this.frame, along = dot(add(this.run.center, eye, -1), unit(forward));
    return {eye, target: add(eye, unit(forward), along > 0 ? along : this.run.radius), up: unit(up)};
  }

  #change(change) {
    const place = this.#place ?? this.#of_frame();
    if (!place) return;
    this.#place = change(place), this.#is_unsent = true;
    this.#show(), this.#send();
  }

  async #send() {  // one at a time, the last in any case
    if (this.#is_sending) return;
    this.#is_sending = true;
    while (this.#is_unsent && this.#place) {
      this.#is_unsent = false, this.#settled = performance.now() + 3000;
      const {eye, target, up} = this.#place;
      await order('camera', [...eye, ...target, ...up].join(' '));
      await new Promise(done => setTimeout(done, 200));
    }
    this.#is_sending = false;
  }

  #forget() { this.#place = null, this.#is_unsent = false, this.#show(); }

  #show() {
    $('place').textContent = this.is_on && this.text() || '\u00a0';
    $('copy').disabled = !this.is_on, $('undo').disabled = !this.#place;
  }
}
