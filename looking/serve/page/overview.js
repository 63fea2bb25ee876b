// All frames at once, as buttons; the canvas over them holds their pictures. Their places are computed, so that of
// thousands only those exist that are near what can be seen.

const gap = 8, label_height = 24, smallest = 84, comfortable = 160, widest_heading = 240, most_elements = 2000;

const place = button => button.firstElementChild;
const pen = document.createElement('canvas').getContext('2d');
function width_of(text) {
  pen.font = '600 14px system-ui, sans-serif';
  return Math.ceil(pen.measureText(text).width) + 4;
}

// As many columns as make the pictures largest without scrolling; small ones scroll. Their width is returned as well.
function columns_for(count, aspect, width, height) {
  let best = 1, largest = 0;
  for (let columns = 1; columns <= count; ++columns) {
    const rows = Math.ceil(count / columns);
    const size = Math.min((width - gap) / columns - gap, ((height - gap) / rows - label_height - gap) * aspect);
    if (size > largest) largest = size, best = columns;
  }
  if (largest >= comfortable) return [best, Math.floor(largest)];
  const size = Math.floor(Math.min(comfortable, width - 2 * gap));
  return [Math.max(Math.floor((width - gap) / (size + gap)), 1), size];
}

export class Overview {
  #name = '';
  #boxes = [];             // {frame or text, x, y, width, height}
  #elements = new Map();   // by the place in #boxes
  #current = -1;

  constructor(element, on_open) {
    this.element = element, this.on_open = on_open;
    new ResizeObserver(() => this.#arrange()).observe(element);
    element.addEventListener('scroll', () => this.#fill());
  }

  show(run, moment) {
    const layout = run.layout(moment), name = JSON.stringify([run.run, layout]);
    if (name === this.#name) return;
    const focused = this.focused();
    this.#name = name, this.run = run, this.layout = layout;
    this.#arrange();
    if (focused >= 0) this.focus(focused);
  }

  #arrange() {
    const {clientWidth: width, clientHeight: height} = this.element;
    if (!this.layout || width === 0) return;
    this.#boxes = [], this.#elements.clear(), this.element.replaceChildren();
    this.layout.rows ? this.#arrange_table(width, height) : this.#arrange_list(width, height);
    const end = document.createElement('div');  // so that all can be scrolled to
    const edge = side => Math.max(...this.#boxes.map(side), 0) + gap - 1;
    end.className = 'end', end.style.transform = `translate(${edge(b => b.x + b.width)}px, ${edge(b => b.y + b.height)}px)`;
    this.element.append(end);
    this.#fill();
  }

  #arrange_list(width, height) {
    const aspect = this.run.width / this.run.height, frames = this.layout.frames;
    const [columns, size] = columns_for(frames.length, aspect, width, height);
    frames.forEach((frame, i) => this.#add(frame, gap + i % columns * (size + gap),
      gap + Math.floor(i / columns) * (size / aspect + label_height + gap), size, size / aspect + label_height));
  }

  #arrange_table(width, height) {
    const {columns, rows} = this.layout, aspect = this.run.width / this.run.height;
    const names = Math.min(Math.max(...rows.map(r => width_of(r.heading))), widest_heading), left = names > 4 ? names + 2 * gap : gap;
    const top = label_height + 2 * gap, room = ((height - top) / rows.length - label_height - gap) * aspect;
    const widest = (width - left) / columns.length - gap;  // if it scrolls, then with pictures of a size to look at
    const size = Math.floor(Math.max(Math.min(Math.max(room, comfortable), widest), smallest));
    const cell_height = size / aspect + label_height;
    const x = column => left + column * (size + gap), y = row => top + row * (cell_height + gap);
    columns.forEach((text, c) => this.#boxes.push({text, x: x(c), y: gap, width: size, height: label_height}));
    rows.forEach((row, r) => {
      if (row.heading) this.#boxes.push({text: row.heading, x: gap, y: y(r), width: left - 2 * gap, height: cell_height});
      row.frames.forEach((frame, c) => { if (frame >= 0) this.#add(frame, x(c), y(r), size, cell_height); });
    });
  }

  #add(frame, x, y, width, height) { this.#boxes.push({frame, x, y, width, height}); }

  #fill() {
    const {scrollTop: top, clientHeight: height} = this.element, has_all = this.#boxes.length <= most_elements;
    this.#boxes.forEach((box, i) => {
      const is_near = has_all || box.y < top + 2 * height && box.y + box.height > top - height;
      const element = this.#elements.get(i);
      if (is_near && !element) this.#elements.set(i, this.#make(box));
      else if (!is_near && element && element !== document.activeElement) element.remove(), this.#elements.delete(i);
    });
  }

  #make(box) {
    const element = document.createElement(box.text === undefined ? 'button' : 'div');
    element.style.cssText = `left: ${box.x}px; top: ${box.y}px; width: ${box.width}px; height: ${box.height}px`;
    if (box.text !== undefined) {
      element.className = box.y === gap ? 'head column' : 'head', element.textContent = element.title = box.text;
    } else {
      const picture = document.createElement('div'), label = document.createElement('span');
      picture.style.height = `${box.height - label_height}px`;
      label.textContent = label.title = this.run.frames[box.frame].label;
      element.append(picture, label);
      element.onclick = () => this.on_open(box.frame);
      element.setAttribute('aria-current', box.frame === this.#current);
    }
    this.element.append(element);
    return element;
  }

  #at(frame) { return this.#boxes.findIndex(box => box.frame === frame); }

  mark(frame) {
    this.#current = frame;
    for (const [i, element] of this.#elements)
      if (this.#boxes[i].frame !== undefined) element.setAttribute('aria-current', this.#boxes[i].frame === frame);
  }
  focus(frame) {
    const at = this.#at(frame), box = this.#boxes[at], {scrollTop: top, clientHeight: height} = this.element;
    if (!box) return;
    if (box.y < top || box.y + box.height > top + height) this.element.scrollTop = box.y - gap, this.#fill();
    this.#elements.get(at)?.focus();
  }
  focused() {
    for (const [i, element] of this.#elements) if (element === document.activeElement) return this.#boxes[i].frame ?? -1;
    return -1;
  }

  // Those that can be seen: [{frame, rect}] relative to `origin`.
  visible(origin) {
    const result = [];
    for (const [i, element] of this.#elements) {
      if (this.#boxes[i].frame === undefined) continue;
      const box = place(element).getBoundingClientRect();
      const rect = {x: box.x - origin.x, y: box.y - origin.y, width: box.width, height: box.height};
      if (rect.y < origin.height && rect.y + rect.height > 0 && rect.x < origin.width && rect.x + rect.width > 0)
        result.push({frame: this.#boxes[i].frame, rect});
    }
    return result;
  }
}
