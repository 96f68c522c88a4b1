// SPDX-License-Identifier: MIT
// What the adapters in Node share: the lines, and shapes as one kind with a turn and a place each.
import readline from 'node:readline';

export class Unsupported extends Error {}

const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
const identity = { rows: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], at: [0, 0, 0] };
const times = (rows, p) => rows.map((row) => dot(row, p));

function mapOf(json) {
  if (json.matrix)
    return { rows: json.matrix.map((r) => r.slice(0, 3)), at: json.matrix.map((r) => r[3] ?? 0) };
  let [x, y, z, w] = json.rotate ?? [0, 0, 0, 1];
  const length = Math.hypot(x, y, z, w);
  [x, y, z, w] = [x / length, y / length, z / length, w / length];
  const k = json.scale ?? 1, scale = Array.isArray(k) ? k : [k, k, k];
  const rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
    [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
    [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]];
  return { rows: rows.map((row) => row.map((e, j) => e * scale[j])), at: json.translate ?? [0, 0, 0] };
}

function joined(outer, inner) {
  const columns = [0, 1, 2].map((j) => inner.rows.map((row) => row[j]));
  return { rows: outer.rows.map((row) => columns.map((column) => dot(row, column))),
    at: times(outer.rows, inner.at).map((x, k) => x + outer.at[k]) };
}

/** The quaternion [x, y, z, w] of a turn. */
export function quaternion(m) {
  const trace = m[0][0] + m[1][1] + m[2][2];
  if (trace > 0) {
    const s = 2 * Math.sqrt(trace + 1);
    return [(m[2][1] - m[1][2]) / s, (m[0][2] - m[2][0]) / s, (m[1][0] - m[0][1]) / s, s / 4];
  }
  const i = m[1][1] > m[0][0] ? (m[2][2] > m[1][1] ? 2 : 1) : m[2][2] > m[0][0] ? 2 : 0;
  const j = (i + 1) % 3, k = (i + 2) % 3, s = 2 * Math.sqrt(1 + m[i][i] - m[j][j] - m[k][k]);
  const q = [0, 0, 0, (m[k][j] - m[j][k]) / s];
  q[i] = s / 4;
  q[j] = (m[j][i] + m[i][j]) / s;
  q[k] = (m[k][i] + m[i][k]) / s;
  return q;
}

/** {kind, sizes or points, rows, at}. `yAxis`: round shapes stand along y, as in Rapier and Jolt. */
export function solidOf(json, yAxis) {
  let map = identity;
  while (json.type === 'transform') {
    map = joined(map, mapOf(json));
    json = json.shape;
  }
  let kind = json.type, points = json.points, sizes = [json.radius, json.half_height];
  if (kind === 'point') points = [json.position ?? [0, 0, 0]];
  if (kind === 'box') sizes = json.half_extents;
  if (kind === 'ellipsoid') sizes = json.radii;
  if (kind === 'rounded' && json.shape.type === 'segment') {
    const [a, b] = json.shape.points, half = b.map((x, k) => (x - a[k]) / 2), length = Math.hypot(...half);
    const z = half.map((x) => x / length), u = Math.abs(z[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0];
    const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let x = cross(u, z);
    x = x.map((e) => e / Math.hypot(...x));
    const y = cross(z, x);
    map = joined(map, { rows: [0, 1, 2].map((i) => [x[i], y[i], z[i]]), at: a.map((e, k) => (e + b[k]) / 2) });
    [kind, sizes] = ['capsule', [json.radius, length]];
  }
  const isTurn = map.rows.every((p, i) => map.rows.every((q, j) => Math.abs(dot(p, q) - (i === j ? 1 : 0)) < 1e-5));
  if (!isTurn) {
    if (kind === 'box') points = [...Array(8).keys()].map((i) => sizes.map((h, k) => (i >> k & 1 ? h : -h)));
    if (!points) throw new Unsupported('a map that is no turn');
    if (kind === 'box') kind = 'hull';
    points = points.map((p) => times(map.rows, p));
    map = { rows: identity.rows, at: map.at };
  }
  if (yAxis && ['capsule', 'cylinder', 'cone'].includes(kind))
    map = joined(map, { rows: [[1, 0, 0], [0, 0, -1], [0, 1, 0]], at: [0, 0, 0] });
  return { kind, sizes, points, rows: map.rows, at: map.at, q: quaternion(map.rows) };
}

const extent = (solid) => Math.max(...solid.at.map(Math.abs)) +
  Math.hypot(...(solid.points ? [Math.max(...solid.points.flat().map(Math.abs)) * 2] : solid.sizes.filter((x) => x)));

/** The largest length of a query, and the end of its motion. */
export function limits(query, ...solids) {
  const origin = query.ray?.origin ?? [0, 0, 0];
  const size = Math.max(...solids.map(extent), ...origin.map(Math.abs));
  const d = query.ray?.direction ?? query.direction ?? [0, 0, 0], e = query.obstacle_direction ?? [0, 0, 0];
  const direction = d.map((x, k) => x - e[k]), speed = Math.hypot(...direction);
  const tMax = query.ray?.t_max ?? query.t_max ?? (speed > 0 ? 4 * size / speed : 1);
  return { size, direction, tMax };
}

export const hit = (t) => ({ status: 'hit', t });
export const miss = { status: 'miss' };
export const unsupported = (why) => ({ status: 'unsupported', why });
export const atDistance = (value) =>
  Number.isFinite(value) ? { status: value > 0 ? 'separated' : 'overlapping', value } : { status: 'failed', why: 'no number' };

function nanoseconds(ask) {
  const times = [];
  for (let sum = 0; times.length < 25 && sum < 5e6;) {
    const start = process.hrtime.bigint();
    ask();
    times.push(Number(process.hrtime.bigint() - start));
    sum += times.at(-1);
  }
  return times.sort((a, b) => a - b)[times.length >> 1];
}

/** Answers stdin, a line a query. `prepare` makes a function of a query that is asked again and again. */
export function serve(about, prepare) {
  readline.createInterface({ input: process.stdin }).on('line', (line) => {
    const query = JSON.parse(line);
    let answer = about;
    if (query.query !== 'about') {
      try {
        const ask = prepare(query);
        answer = ask();
        if (!['unsupported', 'failed'].includes(answer.status)) answer = { ...answer, ns: nanoseconds(ask) };
      } catch (error) {
        // A WebAssembly that trapped is not to be asked again: it counts as a crash.
        if (error instanceof WebAssembly.RuntimeError) process.exit(99);
        answer = error instanceof Unsupported ? unsupported(error.message) : { status: 'failed', why: String(error.message ?? error) };
      }
    }
    process.stdout.write(JSON.stringify(answer) + '\n');
  });
}
