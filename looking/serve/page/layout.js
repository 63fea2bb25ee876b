// Which frames a run has, and where they lie: a table by axes of variations, else one after the other.

const most_columns = 8;

export class Run {
  constructor(json) {
    Object.assign(this, json);
    this.frames = this.frames ?? [], this.axes = this.axes ?? [], this.outputs = this.outputs ?? [];
    this.moments = [...new Set(this.frames.map(f => f.moment))];
    this.variations = [...new Set(this.frames.map(f => f.variation))];
    this.has_axes = this.axes.length > 0 && this.variations.length > 1;
  }

  // The place in `frames`; -1: it is not rendered.
  find(moment, variation) { return this.frames.findIndex(f => f.moment === moment && f.variation === variation); }
  output(name) { return this.outputs.find(o => o.name === name) ?? {name: 'radiance', channels: ['R', 'G', 'B']}; }

  // Axes of which more than one choice is left among these frames: [number].
  #open_axes(frames) {
    return this.axes.map((_, a) => a).filter(a => new Set(frames.map(i => this.frames[i].choices[a])).size > 1);
  }
  #last_axes(axes, frames) {
    const choices = a => new Set(frames.map(i => this.frames[i].choices[a])).size;
    let first = axes.length - 1, columns = choices(axes[first]);
    while (first > 0 && columns * choices(axes[first - 1]) <= most_columns) columns *= choices(axes[--first]);
    return axes.slice(first);
  }
  // Those that the page may have in columns: [[number, name]].
  column_axes() { return this.has_axes ? this.#open_axes(this.frames.map((_, i) => i)).map(a => [a, this.axes[a].name]) : []; }

  // Whose labels have all words of `filter`.
  #filtered(frames) {
    const words = (this.filter ?? '').toLowerCase().split(/\s+/).filter(w => w);
    return frames.filter(i => words.every(w => this.frames[i].label.toLowerCase().includes(w)));
  }

  // {columns: [heading], rows: [{heading, frames}]} for a table; {frames} otherwise. A table shows one moment, and only
  // axes that differ. `this.columns`: the axis in columns; -1: none; nothing: the last ones, as many as go into a window.
  layout(moment) {
    const all = this.frames.map((_, i) => i);
    if (!this.has_axes) return {frames: this.#filtered(all)};
    const shown = this.#filtered(all.filter(i => this.frames[i].moment === moment)), axes = this.#open_axes(shown);
    if (this.columns === -1 || axes.length === 0) return {frames: shown};
    const across = axes.includes(this.columns) ? [this.columns] : this.#last_axes(axes, shown);
    const down = axes.filter(a => !across.includes(a));
    const name_of = (i, some) => some.map(a => this.axes[a].variations[this.frames[i].choices[a]]).join(', ');
    const key_of = (i, some) => some.map(a => String(this.frames[i].choices[a]).padStart(6)).join(' ');
    const keys = [...new Set(shown.map(i => key_of(i, across)))].sort(), columns = [], rows = new Map();
    if (down.length === 0 && keys.length > most_columns) return {frames: shown};
    for (const i of shown) {
      const row = key_of(i, down), column = keys.indexOf(key_of(i, across));
      if (!rows.has(row)) rows.set(row, {heading: name_of(i, down), frames: keys.map(() => -1)});
      rows.get(row).frames[column] = i, columns[column] = name_of(i, across);
    }
    return {columns, rows: [...rows.values()]};
  }
}
