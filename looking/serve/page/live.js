// The page: what is looked at, and how.
import {Camera} from './camera.js';
import {listen, set_up_orders} from './control.js';
import {set_up_keys} from './keys.js';
import {Errors} from './error.js';
import {Large} from './large.js';
import {Run} from './layout.js';
import {Overview} from './overview.js';
import {PlainPainter} from './painter_2d.js';
import {GlPainter} from './painter_gl.js';
import {Pictures, range} from './pictures.js';
import {Relight} from './relight.js';
import {false_colour, highest_stop, kind_of, kinds, lowest_stop, ramp} from './tone.js';
import {curves} from './curves.js';
import {Timeline} from './timeline.js';
import {values_in_words} from './values.js';

const $ = id => document.getElementById(id);
const stage = $('stage'), canvas = $('canvas');
let run = new Run({run: 0}), state = {}, frame = 0, is_large = false, compared = '', drawing = false;
const snapshots = [];  // {name, pictures by "frame output"}

function make_painter() {
  if (!new URLSearchParams(location.search).has('2d'))
    try { return new GlPainter(canvas); } catch (error) { console.warn(error.message); }
  return new PlainPainter(canvas);
}
const painter = make_painter();
const errors = new Errors();
const pictures = new Pictures(fresh => { fresh.forEach(p => errors.add(p)), redraw(); });
// "error" is made of radiance.
const source = name => name === 'error' ? 'radiance' : name;
function picture_of(index, name, halvings) {
  const picture = pictures.best(index, source(name), halvings);
  if (name === 'radiance') return relight.mix(picture, light => pictures.best(index, light, picture.halvings));
  return name === 'error' ? errors.of(picture) : picture;
}
const relight = new Relight(redraw);
const camera = new Camera();
const large = new Large($('large'), camera, redraw);
const overview = new Overview($('cells'), open);
const timeline = new Timeline(moment => { go_to(run.find(moment, run.frames[frame]?.variation)); });

export function redraw() {
  if (drawing) return;
  drawing = true;
  requestAnimationFrame(() => { drawing = false, draw(); });
}

export function open(index) {
  go_to(index);
  is_large = true, show_mode();
  $('large').focus();
}
export function close() {
  if (!is_large) return;
  is_large = false, show_mode();
  overview.focus(frame);
}
function show_mode() {
  $('large').hidden = !is_large, $('cells').hidden = is_large, $('back').disabled = !is_large;
  camera.show(run, is_large ? run.frames[frame] : null);
  redraw();
}

export function go_to(index) {
  if (!run.frames[index]) return;
  frame = index;
  timeline.show(run, run.frames[frame]);
  overview.show(run, run.frames[frame].moment);
  overview.mark(frame);
  camera.show(run, is_large ? run.frames[frame] : null);
  redraw();
}

const output = () => run.output($('output').value);
const exposure = () => $('exposure').valueAsNumber;
const view_of = picture => {
  const kind = kind_of(run.output(picture.output));
  return {kind, tone: Number($('tone').value), exposure: exposure(), range: kind === kinds.ranged ? range(picture) : [0, 1]};
};
const halvings_for = pixels => Math.max(0, Math.floor(Math.log2(run.width / Math.max(pixels, 1)) + .01));

// What is looked at, and of what it is made.
const sources = () => [source(output().name), ...output().name === 'radiance' ? relight.outputs() : []];

// The other side of the wipe: a picture, or null.
function other(halvings) {
  const [kind, index] = compared.split(' ');
  if (kind === 'frame') return picture_of(Number(index), output().name, halvings);
  if (kind === 'snapshot') return snapshots[index]?.pictures.get(`${frame} ${output().name}`) ?? null;
  return null;
}

function draw() {
  const box = stage.getBoundingClientRect(), ratio = devicePixelRatio;
  const width = Math.round(box.width * ratio), height = Math.round(box.height * ratio);
  if (canvas.width !== width || canvas.height !== height) canvas.width = width, canvas.height = height;
  painter.begin();
  const drawn = new Set(), wishes = [];
  if (run.frames.length > 0) is_large ? draw_large(drawn, wishes, {width, height}) : draw_cells(drawn, wishes, box, ratio);
  painter.end(drawn);
  pictures.look(wishes);
}

function draw_cells(drawn, wishes, box, ratio) {
  $('wipe').hidden = true;
  const seen = {x: 0, y: 0, width: $('cells').clientWidth * ratio, height: $('cells').clientHeight * ratio};  // beside scroll bars
  for (const {frame: index, rect} of overview.visible(box)) {
    const scaled = {x: rect.x * ratio, y: rect.y * ratio, width: rect.width * ratio, height: rect.height * ratio};
    const halvings = halvings_for(scaled.width);
    for (const name of sources()) wishes.push({frame: index, output: name, halvings});
    const picture = picture_of(index, output().name, halvings);
    if (!picture) continue;
    drawn.add(picture), painter.draw(picture, scaled, clip(scaled, seen), view_of(picture));
    if (index === frame) legend(picture);
  }
}

function draw_large(drawn, wishes, size) {
  const rect = large.rect(run, size), halvings = halvings_for(rect.width);
  const wish = (index, name) => wishes.push({frame: index, output: name, halvings});
  const wish_all = index => sources().forEach(name => wish(index, name));
  wish_all(frame);
  for (const name of ['radiance', 'radius', 'photons'])
    if (!sources().includes(name) && run.outputs.some(o => o.name === name)) wish(frame, name);
  if (compared.startsWith('frame ')) wish_all(Number(compared.slice(6)));
  if (timeline.is_playing())
    run.frames.forEach((f, i) => { if (f.variation === run.frames[frame].variation && i !== frame) wish_all(i); });
  const picture = picture_of(frame, output().name, halvings), second = other(halvings);
  const split = second ? size.width * $('split').value / 100 : size.width;
  const left = {x: 0, y: 0, width: split, height: size.height};
  const right = {x: split, y: 0, width: size.width - split, height: size.height};
  if (picture) drawn.add(picture), painter.draw(picture, rect, clip(rect, left), view_of(picture)), legend(picture);
  if (second) drawn.add(second), painter.draw(second, rect, clip(rect, right), view_of(second));
  $('wipe').hidden = !second, $('wipe').style.left = `${$('split').value}%`;
  $('values').textContent = values_in_words(run, large.cursor, {picture, second,
    others: ['radiance', 'radius', 'photons'].map(name => pictures.best(frame, name, halvings))});
}

function clip(a, b) {
  const x = Math.max(a.x, b.x), y = Math.max(a.y, b.y);
  return {x, y, width: Math.min(a.x + a.width, b.x + b.width) - x, height: Math.min(a.y + a.height, b.y + b.height) - y};
}

let legend_name = '';
function legend(picture) {
  const view = view_of(picture), is_false = view.kind === kinds.radiance && view.tone === false_colour;
  const is_ranged = view.kind === kinds.ranged && picture.channels === 1;
  const [low, high] = is_ranged ? view.range : [lowest_stop, highest_stop];
  const name = is_false || is_ranged ? `${low} ${high}` : '';
  if (name === legend_name) return;
  legend_name = name;
  const context = $('legend').getContext('2d'), {width} = $('legend');
  context.clearRect(0, 0, width, 34);
  if (!name) return;
  for (let x = 0; x < width; ++x) {
    context.fillStyle = `rgb(${ramp(x / width).map(v => 255 * v).join(' ')})`, context.fillRect(x, 0, 1, 14);
  }
  context.fillStyle = '#f2f2f2', context.font = '12px system-ui, sans-serif';
  const text = v => is_false ? `${v > 0 ? '+' : ''}${v}` : Number(v.toPrecision(3)).toString();
  context.textAlign = 'left', context.fillText(text(low), 0, 29);
  context.textAlign = 'center', context.fillText(is_false ? 'stops from 0.18' : text((low + high) / 2), width / 2, 29);
  context.textAlign = 'right', context.fillText(text(high), width, 29);
}

function options(select, choices) {
  const before = select.value;
  select.replaceChildren(...choices.map(([value, text]) => new Option(text, value)));
  select.value = choices.some(([value]) => value === before) ? before : choices[0]?.[0] ?? '';
}

function list_compared() {
  options($('compare'), [['', 'nothing'], ...snapshots.map((s, i) => [`snapshot ${i}`, s.name]),
                         ...run.frames.map((f, i) => [`frame ${i}`, f.label])]);
  compare();
}
function compare() {
  compared = $('compare').value, $('split').disabled = compared === '';
  redraw();
}

export function keep_snapshot() {
  const kept = new Map(), halvings = is_large ? halvings_for(run.width * large.zoom) : 16;
  run.frames.forEach((_, i) => {
    for (const {name} of run.outputs) {
      const picture = picture_of(i, name, i === frame ? halvings : 16);
      if (picture) kept.set(`${i} ${name}`, picture);
    }
  });
  snapshots.push({name: `snapshot ${snapshots.length + 1}, iteration ${state.iterations ?? 0}`, pictures: kept});
  list_compared();
}

// The first time, the page starts with the view of the PNGs.
let has_view = false;
function take_view(view) {
  if (has_view || !view) return;
  has_view = true;
  $('tone').value = Math.max(curves.findIndex(c => c.name === view.name), 0);
  for (const option of $('tone').options) if (option.value === $('tone').value) option.text += ', as in the PNGs';
  $('exposure').value = view.stops, $('stops').textContent = exposure().toFixed(2);
}

// Which variations the overview shows, and how.
function lay_out() {
  run.columns = $('columns').value === '' ? undefined : Number($('columns').value), run.filter = $('filter').value;
  if (run.frames.length > 0) overview.show(run, run.frames[frame].moment), overview.mark(frame);
  redraw();
}
function list_columns() {
  const axes = run.column_axes();
  $('table').hidden = axes.length === 0;
  options($('columns'), [['', 'as fits'], ...axes.map(([number, name]) => [String(number), name]), ['-1', 'one after the other']]);
  lay_out();
}

async function load_run() {
  const response = await fetch('run');
  run = new Run(await response.json());
  if (run.frames.length > 0) run.outputs.push({name: 'error', channels: ['error'], is_id: 0, names: []});
  pictures.forget(run.frames.length);
  document.title = `${run.scene} - dspm`, $('scene').textContent = run.scene, $('scene').title = run.scene;
  options($('output'), run.outputs.map(o => [o.name, o.name]));
  relight.show(run), take_view(run.view);
  list_compared();
  frame = Math.max(Math.min(frame, run.frames.length - 1), 0);
  list_columns();
  go_to(frame);
}

listen(next => {
  const is_new = next.run !== run.run && next.run !== state.run;
  state = next;
  if (is_new) load_run();
});
set_up_orders(() => state.phase === 'paused');
for (const [id, event] of [['output', 'change'], ['tone', 'change'], ['exposure', 'input'], ['split', 'input']])
  $(id).addEventListener(event, () => { $('stops').textContent = exposure().toFixed(2), redraw(); });
$('columns').onchange = lay_out, $('filter').oninput = lay_out;
$('compare').onchange = compare, $('keep').onclick = keep_snapshot, $('back').onclick = close;
$('cells').addEventListener('scroll', redraw);
$('wipe').addEventListener('pointerdown', e => $('wipe').setPointerCapture(e.pointerId));
$('wipe').addEventListener('pointermove', e => {
  if (!$('wipe').hasPointerCapture(e.pointerId)) return;
  const box = stage.getBoundingClientRect();
  $('split').value = 100 * (e.clientX - box.x) / box.width, redraw();
});
new ResizeObserver(redraw).observe(stage);

set_up_keys({
  close, keep: keep_snapshot, play: () => timeline.toggle(), step: n => timeline.step(n),
  move: n => {
    const at = run.variations.indexOf(run.frames[frame]?.variation);
    go_to(run.find(run.frames[frame]?.moment, run.variations.at((at + n) % run.variations.length)));
  },
  pan: (x, y) => large.pan(x, y), zoom: f => large.zoom_at(f), fit: () => large.fit(), pixels: () => large.pixels(),
  is_large: () => is_large, camera: () => camera.toggle(),
});
