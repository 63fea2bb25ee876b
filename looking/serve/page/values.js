// The values under the cursor, in words.
import {value} from './pictures.js';

const number = v => Number.isFinite(v) ? (v !== 0 && (Math.abs(v) < 1e-3 || Math.abs(v) >= 1e5) ? v.toExponential(3) : v.toPrecision(5)) : String(v);

function line(run, picture, at, name) {
  const x = Math.floor(at.x * picture.width / run.width), y = Math.floor(at.y * picture.height / run.height);
  const values = value(picture, x, y), output = run.output(picture.output);
  if (output.is_id) return `${name}  ${output.names.find(n => Math.fround(n.id) === values[0])?.name ?? 'none'}`;
  return `${name}\n  ${values.map(number).join('  ')}`;
}

export function values_in_words(run, cursor, {picture, second, others}) {
  if (!cursor || !picture) return '\u00a0';
  const lines = [`pixel ${cursor.x}, ${cursor.y}${picture.width < run.width ? ` (mean of ${Math.round(run.width / picture.width)} squared)` : ''}`,
                 line(run, picture, cursor, picture.output)];
  if (second) lines.push(line(run, second, cursor, 'compared'));
  for (const other of others)
    if (other && other.output !== picture.output) lines.push(line(run, other, cursor, other.output));
  lines.push(`iteration ${picture.iterations}${picture.coarse ? ', coarse' : ''}`);
  return lines.join('\n');
}
