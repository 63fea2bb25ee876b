// Keys do what buttons do.

const $ = id => document.getElementById(id);
const next_option = select => { select.selectedIndex = (select.selectedIndex + 1) % select.options.length, select.dispatchEvent(new Event('change')); };
const add = (range, step) => { range.valueAsNumber += step, range.dispatchEvent(new Event('input')); };

export function set_up_keys(does) {
  document.addEventListener('keydown', e => {
    const on = e.target.tagName;
    if (e.ctrlKey || e.metaKey || e.altKey || on === 'SELECT' || on === 'INPUT' && ['number', 'search'].includes(e.target.type)) return;
    if (on === 'INPUT' && e.key.startsWith('Arrow') || on === 'BUTTON' && (e.key === ' ' || e.key === 'Enter') || e.target.id === 'log') return;
    const arrow = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[e.key];
    if (arrow) {
      if (e.shiftKey) does.is_large() && does.pan(-48 * arrow[0], -48 * arrow[1]);
      else arrow[0] ? does.step(arrow[0]) : does.move(arrow[1]);
      return e.preventDefault();
    }
    const keys = {Escape: does.close, ' ': does.play, '+': () => does.zoom(2), '=': () => does.zoom(2), '-': () => does.zoom(.5),
      0: does.fit, 1: does.pixels, e: () => add($('exposure'), .5), E: () => add($('exposure'), -.5), t: () => next_option($('tone')),
      o: () => next_option($('output')), s: does.keep, c: does.camera, p: () => $('pause').click()};
    if (!keys[e.key]) return;
    keys[e.key]();
    e.preventDefault();
  });
}
