// The state of the run and its log from the server, and orders to it.

const $ = id => document.getElementById(id);
const time = s => s < 60 ? `${s.toFixed(s < 10 ? 1 : 0)} s` : s < 3600
  ? `${Math.floor(s / 60)} min ${Math.round(s % 60)} s` : `${Math.floor(s / 3600)} h ${Math.round(s % 3600 / 60)} min`;

export const order = (name, body) => fetch(name, {method: 'POST', body}).then(r => {
  if (!r.ok) notice(`dspm refuses: ${name}`, true);
}).catch(() => notice('dspm does not answer', true));

export function notice(text, is_error = false) {
  $('notice').textContent = text;
  $('notice').className = is_error ? 'error' : '';
}

function in_words(state) {
  const done = `iteration ${state.iterations}${state.of ? ` of ${state.of}` : ''}`;
  const step = state.step.startsWith('iteration ') ? 'rendering' : state.step;
  const words = [state.phase === 'rendering' ? step : state.phase, done, time(state.seconds)];
  if (state.left !== undefined && state.phase === 'rendering') words.push(`${time(state.left)} left`);
  if (state.error !== undefined) words.push(`error ${(100 * state.error).toPrecision(2)}%`);
  return words.join(' · ');
}

function show(state) {
  $('state').textContent = in_words(state);
  $('progress').value = state.share;
  $('pause').textContent = state.phase === 'paused' ? 'Go on' : 'Pause';
  const ended = state.phase === 'done';
  $('pause').disabled = ended;
  const starts = state.guided === 1 ? 'as learned before the edit' : 'unguided';
  notice(state.coarse === 1 && state.iterations > 0 ? `Coarse: a quarter of the size, fewer photons, which start ${starts}` : '');
}

function log(text) {
  const box = $('log'), at_end = box.scrollTop + box.clientHeight > box.scrollHeight - 8;
  const line = document.createElement('span');
  line.textContent = text;
  line.className = /\berror: /.test(text) ? 'error' : /\bwarning: /.test(text) ? 'warning' : '';
  box.append(line);
  while (box.childElementCount > 1000) box.firstElementChild.remove();
  if (at_end) box.scrollTop = box.scrollHeight;
}

// Calls on_state(state) with each.
export function listen(on_state) {
  const events = new EventSource('events');
  events.addEventListener('state', e => {
    const state = JSON.parse(e.data);
    if (state.phase !== undefined) show(state), on_state(state);
  });
  events.addEventListener('problem', e => {
    const text = JSON.parse(e.data);
    $('problem').textContent = text, $('problem').hidden = text === '';
  });
  events.addEventListener('line', e => log(JSON.parse(e.data)));
  events.onerror = () => { $('state').textContent = 'not connected', notice('dspm has ended, or does not answer', true); };
}

export function set_up_orders(paused) {
  $('pause').onclick = () => order(paused() ? 'resume' : 'pause');
  $('write').onclick = () => order('write');
  $('add').onclick = () => order('more', String($('more').valueAsNumber || ''));
  $('stop').onclick = () => order('stop');
}
