// SPDX-License-Identifier: MIT
// HTML, style and script of a motion's page. The script draws triangles back to front.
#include "renderer/plan/motion_page.h"

namespace minkray {

std::string motion_page_html() {
  return R"page(<!doctype html>
<!-- SPDX-License-Identifier: MIT -->
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="Minkray">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'">
<link rel="icon" href="data:,">
<title>Minkray motion</title>
<style>
body { font: 15px/1.4 sans-serif; margin: 1em; background: #fafafa; color: #222; }
h1 { font-size: 1.2em; }
pre { white-space: pre-wrap; background: #eee; padding: 0.6em; }
canvas { width: 100%; height: 65vh; background: #fff; border: 1px solid #ccc; touch-action: none; }
.bar { display: flex; gap: 0.6em; align-items: center; margin: 0.5em 0; flex-wrap: wrap; }
#time { flex: 1; min-width: 12em; }
button { font: inherit; }
.a { color: #d9660a; font-weight: bold; } .b { color: #1a5fd0; font-weight: bold; }
table { border-collapse: collapse; } td, th { padding: 0.2em 0.8em 0.2em 0; text-align: left; }
</style>
</head>
<body>
<h1>Motion: <span id="status"></span></h1>
<pre id="text"></pre>
<canvas id="view" tabindex="0" role="img" aria-label="The robot. Drag turns it, the wheel zooms."></canvas>
<div class="bar">
  <button type="button" id="play">Play</button>
  <button type="button" id="worst">Worst moment</button>
  <input type="range" id="time" min="0" max="1000" value="0" aria-label="Time">
  <output id="shown"></output>
</div>
<p>Shown in colour: <span class="a" id="a"></span> <span class="b" id="b"></span></p>
<div id="list"></div>
<script type="application/json" id="motion"><!-- motion --></script>
<script>
'use strict';
const motion = JSON.parse(document.getElementById('motion').textContent);
const find = id => document.getElementById(id);
const canvas = find('view'), context = canvas.getContext('2d');
const first = motion.times[0], last = motion.times[motion.times.length - 1];
let time = motion.worst, playing = false, zoom = 1;
let azimuth = Math.atan2(motion.view[1], motion.view[0]), elevation = Math.asin(motion.view[2] / Math.hypot(...motion.view));
/** A time in seconds, or in rows if the motion has no times. */
const timeText = t => motion.has_times ? t.toFixed(3) + ' s' : 'row ' + (t + 1).toFixed(3);
let pair = [motion.verdict.a, motion.verdict.b];

function mix(p, q, s) { return p.map((x, i) => x + s * (q[i] - x)); }
/** Rotation matrix of a quaternion x, y, z, w of any length. */
function turnOf(q) {
  const n = Math.hypot(...q) || 1, [x, y, z, w] = q.map(c => c / n);
  return [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)];
}
function posesAt(t) {
  let k = motion.times.findIndex(one => one > t);
  if (k < 1) k = k === 0 ? 1 : motion.times.length - 1;
  const from = motion.times[Math.max(k - 1, 0)], to = motion.times[k] ?? from;
  const s = to > from ? Math.min(1, Math.max(0, (t - from) / (to - from))) : 0;
  const p = motion.poses[Math.max(k - 1, 0)], q = motion.poses[k] ?? p, poses = [];
  for (let i = 0; i < p.length; i += 7) {
    const a = p.slice(i + 3, i + 7);
    let b = q.slice(i + 3, i + 7);
    if (a.reduce((sum, x, j) => sum + x * b[j], 0) < 0) b = b.map(x => -x);
    poses.push({at: mix(p.slice(i, i + 3), q.slice(i, i + 3), s), turn: turnOf(mix(a, b, s))});
  }
  return poses;
}
function cornersOf(body, poses) {
  const v = body.v, pose = body.link < 0 ? null : poses[body.link], corners = [];
  for (let i = 0; i < v.length; i += 3) {
    const [x, y, z] = [v[i], v[i + 1], v[i + 2]];
    if (!pose) { corners.push([x, y, z]); continue; }
    const m = pose.turn, o = pose.at;
    corners.push([m[0] * x + m[1] * y + m[2] * z + o[0], m[3] * x + m[4] * y + m[5] * z + o[1],
      m[6] * x + m[7] * y + m[8] * z + o[2]]);
  }
  return corners;
}
/** Middle and size of what the robot passes over: the view turns about it. */
const around = (() => {
  const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
  for (let k = 0; k <= 8; ++k) {
    const poses = posesAt(first + (last - first) * k / 8);
    motion.bodies.filter(body => body.link >= 0).forEach(body => cornersOf(body, poses).forEach(p =>
      p.forEach((x, i) => { low[i] = Math.min(low[i], x); high[i] = Math.max(high[i], x); })));
  }
  if (low[0] > high[0]) return {middle: [0, 0, 0], size: 1};
  return {middle: mix(low, high, 0.5), size: Math.hypot(...high.map((x, i) => x - low[i])) || 1};
})();
/** Cuts triangles with a side longer than `longest` in half, so that far ones are drawn first. */
function cut(body, longest) {
  const open = [];
  for (let i = 0; i < body.t.length; i += 3) open.push(body.t.slice(i, i + 3));
  const done = [], corner = i => body.v.slice(3 * i, 3 * i + 3), middles = new Map();
  while (open.length) {
    const t = open.pop();
    let longestSide = 0, side = 0;
    for (let k = 0; k < 3; ++k) {
      const p = corner(t[k]), q = corner(t[(k + 1) % 3]);
      const length = Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      if (length > longestSide) { longestSide = length; side = k; }
    }
    if (longestSide <= longest || done.length + open.length > 4000) { done.push(...t); continue; }
    const i = t[side], j = t[(side + 1) % 3], k = t[(side + 2) % 3], key = Math.min(i, j) + ',' + Math.max(i, j);
    if (!middles.has(key)) {
      middles.set(key, body.v.length / 3);
      body.v.push(...mix(corner(i), corner(j), 0.5));
    }
    open.push([i, middles.get(key), k], [middles.get(key), j, k]);
  }
  body.flat = body.t.length <= 6;
  body.t = done;
}
motion.bodies.forEach(body => cut(body, around.size / 8));
function draw() {
  const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth * ratio, h = canvas.clientHeight * ratio;
  canvas.width = w; canvas.height = h;
  const ca = Math.cos(azimuth), sa = Math.sin(azimuth), ce = Math.cos(elevation), se = Math.sin(elevation);
  const out = [ca * ce, sa * ce, se], right = [-sa, ca, 0], up = [-ca * se, -sa * se, ce];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const scale = zoom * 0.6 * Math.min(w, h) / around.size, poses = posesAt(time), faces = [];
  motion.bodies.forEach((body, index) => {
    const corners = cornersOf(body, poses).map(p => {
      const r = p.map((x, i) => x - around.middle[i]);
      return [dot(r, right), dot(r, up), dot(r, out)];
    });
    const name = motion.names[index];
    // Obstacles are transparent so that they do not hide the robot.
    const alpha = body.link >= 0 ? 1 : name === pair[0] || name === pair[1] ? 0.6 : 0.4;
    const colour = name === pair[0] ? [235, 120, 20] : name === pair[1] ? [40, 105, 225]
      : body.link < 0 ? [165, 160, 140] : [150, 160, 170];
    for (let i = 0; i < body.t.length; i += 3) {
      const [p, q, r] = [corners[body.t[i]], corners[body.t[i + 1]], corners[body.t[i + 2]]];
      const u = q.map((x, k) => x - p[k]), v = r.map((x, k) => x - p[k]);
      const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const size = Math.hypot(...n);
      if (!(n[2] > 0) && !body.flat) continue;
      const light = 0.45 + 0.55 * Math.abs(n[2] * 0.8 + n[1] * 0.6) / (size || 1);
      faces.push({depth: p[2] + q[2] + r[2], points: [p, q, r],
        alpha, colour: 'rgb(' + colour.map(c => Math.round(c * Math.min(1, light))).join(',') + ')'});
    }
  });
  faces.sort((a, b) => a.depth - b.depth);
  for (const face of faces) {
    context.beginPath();
    face.points.forEach((p, i) => context[i ? 'lineTo' : 'moveTo'](w / 2 + scale * p[0], h / 2 - scale * p[1]));
    context.closePath();
    context.fillStyle = context.strokeStyle = face.colour;
    context.globalAlpha = face.alpha;
    context.fill();
    if (face.alpha === 1) context.stroke();
  }
  find('shown').textContent = timeText(time);
  find('time').value = last > first ? 1000 * (time - first) / (last - first) : 0;
  find('a').textContent = pair[0] ?? ''; find('b').textContent = pair[1] ?? '';
}
function show(t) { time = Math.min(last, Math.max(first, t)); draw(); }
let before = 0;
function step(now) {
  if (!playing) return;
  const t = time + (before ? (now - before) / 1000 * Math.max(1, (last - first) / 20) : 0);
  before = now;
  show(t > last ? first : t);
  requestAnimationFrame(step);
}
find('play').onclick = () => {
  playing = !playing; before = 0;
  find('play').textContent = playing ? 'Pause' : 'Play';
  if (playing) requestAnimationFrame(step);
};
find('worst').onclick = () => show(motion.worst);
find('time').oninput = event => show(first + (last - first) * event.target.value / 1000);
canvas.addEventListener('pointerdown', event => canvas.setPointerCapture(event.pointerId));
canvas.addEventListener('pointermove', event => {
  if (!(event.buttons & 1)) return;
  azimuth -= event.movementX * 0.008;
  elevation = Math.min(1.57, Math.max(-1.57, elevation + event.movementY * 0.008));
  draw();
});
canvas.addEventListener('wheel', event => {
  event.preventDefault();
  zoom *= Math.exp(-0.001 * event.deltaY);
  draw();
}, {passive: false});
find('status').textContent = motion.verdict.status;
find('text').textContent = motion.text;
const stretches = motion.verdict.collisions.concat(motion.verdict.undecided);
if (stretches.length) {
  const table = document.createElement('table');
  for (const stretch of stretches) {
    const row = table.insertRow(), button = document.createElement('button');
    button.textContent = 'Show';
    button.onclick = () => { pair = [stretch.a, stretch.b]; show(stretch.time ?? stretch.begin); };
    row.insertCell().append(button);
    for (const text of [stretch.a, stretch.b, timeText(stretch.begin) + ' to ' + timeText(stretch.end)])
      row.insertCell().textContent = text;
  }
  find('list').append(table);
  const worst = motion.verdict.collisions.find(one => one.time === motion.worst);
  if (worst) pair = [worst.a, worst.b];
}
window.addEventListener('resize', draw);
show(motion.worst);
</script>
</body>
</html>
)page";
}

}  // namespace minkray
