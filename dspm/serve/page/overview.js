// All frames at once, as buttons; the canvas over them holds their pictures.

const place = button => button.firstElementChild;

export class Overview {
  #buttons = [];  // by frame
  #name = '';

  constructor(element, on_open) {
    this.element = element, this.on_open = on_open;
    new ResizeObserver(() => this.#fit()).observe(element);
  }

  show(run, moment) {
    const layout = run.layout(moment), name = JSON.stringify([run.run, layout]);
    if (name === this.#name) return;
    this.#name = name;
    this.run = run, this.layout = layout;
    const focused = this.#buttons.indexOf(document.activeElement);
    this.#buttons = [];
    this.element.replaceChildren();
    const head = text => {
      const div = document.createElement('div');
      div.className = 'head', div.textContent = text;
      this.element.append(div);
    };
    if (layout.rows) {
      head(''), layout.columns.forEach(head);
      for (const row of layout.rows) head(row.heading), row.frames.forEach(f => this.#add(f));
    } else {
      layout.frames.forEach(f => this.#add(f));
    }
    this.#fit();
    this.#buttons[focused]?.focus();
  }

  #add(frame) {
    const button = document.createElement(frame < 0 ? 'div' : 'button');
    this.element.append(button);
    if (frame < 0) return;
    const picture = document.createElement('div'), label = document.createElement('span');
    picture.style.aspectRatio = `${this.run.width} / ${this.run.height}`;
    label.textContent = this.run.frames[frame].label;
    button.append(picture, label);
    button.onclick = () => this.on_open(frame);
    this.#buttons[frame] = button;
  }

  // As many columns as make the pictures largest without scrolling; a table has its own.
  #fit() {
    if (!this.layout) return;
    const {clientWidth: width, clientHeight: height} = this.element, style = this.element.style;
    if (this.layout.rows) {
      const columns = this.layout.columns.length, has_names = this.layout.rows.some(r => r.heading);
      style.gridTemplateColumns = `${has_names ? 'minmax(4rem, max-content)' : '0'} repeat(${columns}, minmax(6rem, 1fr))`;
      const rows = this.layout.rows.length, room = (height - 50) / rows - 32;
      const widest = Math.max(room * this.run.width / this.run.height, 96);
      style.gridTemplateColumns =
        `${has_names ? 'minmax(4rem, max-content)' : '0'} repeat(${columns}, minmax(6rem, ${Math.floor(widest)}px))`;
      return;
    }
    const count = this.layout.frames.length, aspect = this.run.height / this.run.width;
    let best = 1, largest = 0;
    for (let columns = 1; columns <= count; ++columns) {
      const rows = Math.ceil(count / columns);
      const size = Math.min((width - 8) / columns - 8, ((height - 8) / rows - 32) / aspect);
      if (size > largest) largest = size, best = columns;
    }
    const size = Math.floor(Math.max(largest, Math.min(160, width - 16)));
    style.gridTemplateColumns = largest >= 160 ? `repeat(${best}, ${size}px)` : `repeat(auto-fill, ${size}px)`;
  }

  mark(frame) { this.#buttons.forEach((b, i) => b.setAttribute('aria-current', i === frame)); }
  focus(frame) { this.#buttons[frame]?.focus(); }
  focused() { return this.#buttons.indexOf(document.activeElement); }

  // Those that can be seen: [{frame, rect}] relative to `origin`.
  visible(origin) {
    const result = [];
    this.#buttons.forEach((button, frame) => {
      const box = place(button).getBoundingClientRect();
      const rect = {x: box.x - origin.x, y: box.y - origin.y, width: box.width, height: box.height};
      if (rect.y < origin.height && rect.y + rect.height > 0 && rect.x < origin.width && rect.x + rect.width > 0)
        result.push({frame, rect});
    });
    return result;
  }
}
