// Which frames a run has, and where they lie: a table by axes of variations, else one after the other.

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

  // {columns: [heading], rows: [{heading, frames}]} for a table; {frames} otherwise. A table shows one moment.
  layout(moment) {
    if (!this.has_axes) return {frames: this.frames.map((_, i) => i)};
    const last = this.axes.length - 1, columns = this.axes[last].variations.map(v => v), rows = new Map();
    this.frames.forEach((frame, i) => {
      if (frame.moment !== moment) return;
      const row = frame.choices.slice(0, last).join(' ');
      if (!rows.has(row)) {
        const names = frame.choices.slice(0, last).map((choice, axis) => this.axes[axis].variations[choice]);
        rows.set(row, {heading: names.join(', '), frames: columns.map(() => -1)});
      }
      rows.get(row).frames[frame.choices[last]] = i;
    });
    const used = columns.map((_, c) => [...rows.values()].some(row => row.frames[c] >= 0));
    if (rows.size === 1 && columns.length > 8) return {frames: [...rows.values()][0].frames.filter(i => i >= 0)};
    return {columns: columns.filter((_, c) => used[c]),
            rows: [...rows.values()].map(r => ({heading: r.heading, frames: r.frames.filter((_, c) => used[c])}))};
  }
}
