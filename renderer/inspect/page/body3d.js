// SPDX-License-Identifier: MIT
// The mesh around a triangle, which need not be convex: its faces from the furthest to the nearest.

/** @param {Scene3D} scene where it is seen @param {CanvasRenderingContext2D} pen @param {Body} body
 *  @param {number[]} at the triangle's middle, the origin of what is seen */
function drawBody(scene, pen, body, at) {
  const origin = minus(body.middle, at);
  const back = cross(scene.right, scene.up);
  const count = body.v.length / 3;
  const x = new Float64Array(count), y = new Float64Array(count), z = new Float64Array(count);
  for (let i = 0; i < count; ++i) {
    const point = plus(origin, times(body.scale, body.v.slice(3 * i, 3 * i + 3)));
    [x[i], y[i]] = scene.place(point);
    z[i] = scene.scale() * dot(point, back);
  }
  const depth = new Float64Array(body.t.length / 3);
  for (let i = 0; i < depth.length; ++i) depth[i] = z[body.t[3 * i]] + z[body.t[3 * i + 1]] + z[body.t[3 * i + 2]];
  const order = Array.from(depth.keys()).sort((i, j) => depth[i] - depth[j]);
  const colour = styleColour('shape');
  const base = [1, 3, 5].map(from => parseInt(colour.slice(from, from + 2), 16));
  pen.lineWidth = 0.5;
  pen.strokeStyle = styleColour('rule');
  for (const i of order) {
    const [a, b, c] = body.t.slice(3 * i, 3 * i + 3);
    const n = unit(cross([x[b] - x[a], y[b] - y[a], z[b] - z[a]], [x[c] - x[a], y[c] - y[a], z[c] - z[a]]));
    const light = 0.6 + 0.6 * Math.abs(0.35 * n[0] + 0.55 * n[1] - 0.75 * n[2]);
    pen.fillStyle = 'rgb(' + base.map(k => Math.min(255, Math.round(k * light))).join(',') + ')';
    pen.beginPath();
    pen.moveTo(x[a], y[a]);
    pen.lineTo(x[b], y[b]);
    pen.lineTo(x[c], y[c]);
    pen.closePath();
    pen.fill();
    pen.stroke();
  }
}
