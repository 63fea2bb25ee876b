// The same as painter_gl.js for browsers without WebGL 2: each picture is tone mapped once for each view of it.
import {value} from './pictures.js';
import {shown} from './tone.js';

export class PlainPainter {
  #bitmaps = new Map();  // by picture: {view, canvas}

  constructor(canvas) {
    this.canvas = canvas, this.context = canvas.getContext('2d');
  }

  begin() { this.context.clearRect(0, 0, this.canvas.width, this.canvas.height); }

  draw(picture, rect, clip, view) {
    if (clip.width < 1 || clip.height < 1) return;
    const {context} = this;
    context.save();
    context.beginPath(), context.rect(clip.x, clip.y, clip.width, clip.height), context.clip();
    context.imageSmoothingEnabled = (picture.bytes === 2 || picture.is_smooth) && rect.width < 2 * picture.width;
    context.drawImage(this.#bitmap(picture, view), rect.x, rect.y, rect.width, rect.height);
    context.restore();
  }

  end(drawn) {
    for (const picture of this.#bitmaps.keys()) if (!drawn.has(picture)) this.#bitmaps.delete(picture);
  }

  #bitmap(picture, view) {
    const name = JSON.stringify(view), known = this.#bitmaps.get(picture);
    if (known?.name === name) return known.canvas;
    const canvas = document.createElement('canvas');
    canvas.width = picture.width, canvas.height = picture.height;
    const context = canvas.getContext('2d'), pixels = context.createImageData(picture.width, picture.height);
    for (let y = 0, at = 0; y < picture.height; ++y)
      for (let x = 0; x < picture.width; ++x, at += 4) {
        const rgb = shown(value(picture, x, y), view);
        for (let c = 0; c < 3; ++c) pixels.data[at + c] = rgb[c] * 255 + .5;
        pixels.data[at + 3] = 255;
      }
    context.putImageData(pixels, 0, 0);
    this.#bitmaps.set(picture, {name, canvas});
    return canvas;
  }
}
