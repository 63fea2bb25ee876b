// One picture: zoom, pan, and where the cursor is. Sizes are in the canvas's pixels.

export class Large {
  #fits = true;
  zoom = 1;          // of the canvas's pixels to the image's
  x = 0; y = 0;      // the image's upper left corner
  cursor = null;     // {x, y} of the image, or null
  #drag = null;

  // `camera`: takes the mouse if it is on.
  constructor(element, camera, on_change) {
    this.element = element, this.camera = camera, this.on_change = on_change;
    element.addEventListener('wheel', e => {
      e.preventDefault();
      if (camera.is_on) return camera.dolly(Math.exp(e.deltaY * .0015));
      this.zoom_at(Math.exp(-e.deltaY * .0015), ...this.#point(e));
    }, {passive: false});
    element.addEventListener('pointerdown', e => {
      this.#drag = this.#point(e), element.setPointerCapture(e.pointerId), element.focus();
    });
    element.addEventListener('pointermove', e => this.#move(...this.#point(e), e.shiftKey));
    element.addEventListener('pointerup', () => this.#drag = null);
    element.addEventListener('pointercancel', () => this.#drag = null);
    element.addEventListener('pointerleave', () => { this.cursor = null, this.on_change(); });
    element.addEventListener('dblclick', e => this.#fits ? this.pixels(...this.#point(e)) : this.fit());
  }

  #point(event) {
    const box = this.element.getBoundingClientRect();
    return [(event.clientX - box.x) * devicePixelRatio, (event.clientY - box.y) * devicePixelRatio];
  }

  #move(x, y, shift) {
    if (this.#drag) {
      const [dx, dy] = [x - this.#drag[0], y - this.#drag[1]];
      this.#drag = [x, y];
      if (!this.camera.is_on) this.pan(dx, dy);
      else shift ? this.camera.pan(dx, dy, this.size.height) : this.camera.orbit(dx, dy);
    }
    const at = {x: Math.floor((x - this.x) / this.zoom), y: Math.floor((y - this.y) / this.zoom)};
    const inside = at.x >= 0 && at.y >= 0 && at.x < this.run?.width && at.y < this.run?.height;
    this.cursor = inside ? at : null;
    this.on_change();
  }

  pan(dx, dy) { this.#fits = false, this.x += dx, this.y += dy, this.on_change(); }

  zoom_at(factor, x = this.size?.width / 2, y = this.size?.height / 2) {
    const zoom = Math.min(Math.max(this.zoom * factor, 1 / 64), 64);
    this.x = x - (x - this.x) * zoom / this.zoom, this.y = y - (y - this.y) * zoom / this.zoom;
    this.zoom = zoom, this.#fits = false;
    this.on_change();
  }

  fit() { this.#fits = true, this.on_change(); }
  pixels(x, y) { this.zoom_at(1 / this.zoom, x, y), this.x = Math.round(this.x), this.y = Math.round(this.y); }

  // Where the image lies on a canvas of that size.
  rect(run, size) {
    this.run = run, this.size = size;
    if (this.#fits) {
      this.zoom = Math.min(size.width / run.width, size.height / run.height);
      this.x = (size.width - run.width * this.zoom) / 2, this.y = (size.height - run.height * this.zoom) / 2;
    }
    return {x: this.x, y: this.y, width: run.width * this.zoom, height: run.height * this.zoom};
  }
}
