// The scrubber: goes to moments of the animation, and plays them at the scene's rate.

const $ = id => document.getElementById(id);

export class Timeline {
  #timer = 0;
  #run = null;

  constructor(on_moment) {
    this.on_moment = on_moment;
    $('scrub').oninput = () => this.#go($('scrub').valueAsNumber);
    $('play').onclick = () => this.toggle();
  }

  show(run, frame) {
    this.#run = run;
    const last = run.moments.length - 1;
    $('scrub').max = last, $('scrub').value = run.moments.indexOf(frame.moment);
    $('scrub').disabled = $('play').disabled = last === 0;
    $('moment').textContent = last > 0 ? `frame ${frame.moment}, ${$('scrub').valueAsNumber + 1} of ${last + 1}` : frame.label;
    if (last === 0) this.#stop();
  }

  is_playing() { return this.#timer !== 0; }

  toggle() {
    if (this.is_playing()) return this.#stop();
    if (!this.#run || this.#run.moments.length < 2) return;
    const begin = performance.now(), first = $('scrub').valueAsNumber, fps = this.#run.fps || 24;
    const next = now => {
      const at = first + Math.floor(Math.max(now - begin, 0) / 1000 * fps);
      const index = at % this.#run.moments.length;
      if (index !== $('scrub').valueAsNumber) this.#go(index);
      this.#timer = requestAnimationFrame(next);
    };
    this.#timer = requestAnimationFrame(next);
    $('play').textContent = 'Stop';
  }

  step(n) { if (this.#run) this.#go(($('scrub').valueAsNumber + n + this.#run.moments.length) % this.#run.moments.length); }

  #go(index) { $('scrub').value = index, this.on_moment(this.#run.moments[index]); }
  #stop() { cancelAnimationFrame(this.#timer), this.#timer = 0, $('play').textContent = 'Play'; }
}
