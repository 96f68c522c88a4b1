// SPDX-License-Identifier: MIT
// A view of a convex shape and of points, lines and planes around it. All that has a surface is convex,
// so that its far faces, then what is within, then its near faces are the right order: neither a depth
// buffer nor a graphics card is needed. Only the mesh around a triangle is sorted by depth (body3d.js).
// Projection is parallel: what is square to the ray looks so.

class Scene3D {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.layer = document.createElement('canvas');
    /** @type {ShapeMesh | null} */
    this.mesh = null;
    /** @type {Item[]} */
    this.items = [];
    this.radius = 1;
    this.centre = [0, 0, 0];
    this.zoom = 1;
    this.flat = false;
    this.right = [1, 0, 0];
    this.up = [0, 0, 1];
    this.inner = true;
    this.outer = true;
    this.around = true;
    this.listen();
  }

  /** Looks at all of a shape. @param {Play} play */
  look(play) {
    this.mesh = play.mesh;
    this.radius = play.radius > 0 ? play.radius : 1;
    this.flat = play.flat;
    this.right = play.look.right;
    this.up = play.look.up;
    this.whole();
  }

  whole() {
    this.centre = [0, 0, 0];
    this.zoom = 1;
  }

  /** @param {number} yaw @param {number} pitch in radians */
  turn(yaw, pitch) {
    if (this.flat) return;
    const back = cross(this.right, this.up);
    const right = plus(times(Math.cos(yaw), this.right), times(-Math.sin(yaw), back));
    const turned = cross(right, this.up);
    this.up = unit(plus(times(Math.cos(pitch), this.up), times(-Math.sin(pitch), turned)));
    this.right = unit(minus(right, times(dot(right, this.up), this.up)));
    this.draw();
  }

  listen() {
    const canvas = this.canvas;
    /** @type {Map<number, {x: number, y: number}>} */
    const fingers = new Map();
    canvas.addEventListener('pointerdown', event => {
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', event => {
      const from = fingers.get(event.pointerId);
      if (!from) return;
      const dx = event.clientX - from.x, dy = event.clientY - from.y;
      if (fingers.size === 2) {
        const other = [...fingers].filter(([id]) => id !== event.pointerId)[0][1];
        const before = Math.hypot(from.x - other.x, from.y - other.y);
        const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
        if (before > 0) this.zoom *= after / before;
        this.draw();
      } else if (this.flat || event.shiftKey) {
        const scale = this.scale();
        this.centre = plus(this.centre, plus(times(-dx / scale, this.right), times(dy / scale, this.up)));
        this.draw();
      } else {
        this.turn(dx * 0.01, dy * 0.01);
      }
      fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    });
    for (const end of ['pointerup', 'pointercancel'])
      canvas.addEventListener(end, event => fingers.delete(/** @type {PointerEvent} */ (event).pointerId));
    canvas.addEventListener('wheel', event => {
      event.preventDefault();
      this.zoom *= Math.exp(-event.deltaY * 0.0015);
      this.draw();
    }, { passive: false });
    canvas.addEventListener('keydown', event => {
      const step = 0.12;
      /** @type {Record<string, () => void>} */
      const actions = {
        ArrowLeft: () => this.turn(-step, 0),
        ArrowRight: () => this.turn(step, 0),
        ArrowUp: () => this.turn(0, -step),
        ArrowDown: () => this.turn(0, step),
        '+': () => { this.zoom *= 1.3; this.draw(); },
        '-': () => { this.zoom /= 1.3; this.draw(); },
      };
      const action = actions[event.key];
      if (!action) return;
      event.preventDefault();
      action();
    });
  }

  /** Pixels of the page a unit. */
  scale() {
    const { clientWidth, clientHeight } = this.canvas;
    return this.zoom * 0.36 * Math.min(clientWidth, clientHeight) / this.radius;
  }

  /** @param {number[]} point in space @returns {[number, number]} */
  place(point) {
    const from = minus(point.length === 2 ? [point[0], point[1], 0] : point, this.centre);
    const scale = this.scale();
    return [
      this.canvas.clientWidth / 2 + scale * dot(from, this.right),
      this.canvas.clientHeight / 2 - scale * dot(from, this.up),
    ];
  }

  draw() {
    const { canvas, layer } = this;
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth, height = canvas.clientHeight;
    for (const c of [canvas, layer]) {
      c.width = Math.round(width * ratio);
      c.height = Math.round(height * ratio);
    }
    const pen = canvas.getContext('2d');
    const faces = layer.getContext('2d');
    if (!pen || !faces) return;
    pen.scale(ratio, ratio);
    faces.scale(ratio, ratio);
    const put = (/** @type {MeshData | undefined} */ mesh, /** @type {boolean} */ near, /** @type {number} */ alpha) => {
      if (!mesh || mesh.t.length === 0) return;
      faces.clearRect(0, 0, width, height);
      this.drawFaces(faces, mesh, near);
      pen.save();
      pen.resetTransform();
      pen.globalAlpha = alpha;
      pen.drawImage(layer, 0, 0);
      pen.restore();
    };
    const mesh = this.mesh;
    if (mesh && mesh.around && this.around) {
      faces.clearRect(0, 0, width, height);
      drawBody(this, faces, mesh.around, mesh.at || [0, 0, 0]);
      pen.save();
      pen.resetTransform();
      pen.globalAlpha = 0.4;
      pen.drawImage(layer, 0, 0);
      pen.restore();
    }
    if (mesh && this.outer) put(mesh.outer, false, 0.16);
    if (mesh && this.inner) put(mesh.inner, false, 0.5);
    for (const item of this.items) this.drawItem(pen, item, 1);
    if (mesh && this.inner) put(mesh.inner, true, 0.34);
    if (mesh && this.outer) put(mesh.outer, true, 0.1);
    for (const item of this.items) if (item.kind !== 'area') this.drawItem(pen, item, 0.6);
  }

  /** Fills the faces that look at us, or away. @param {CanvasRenderingContext2D} pen @param {MeshData} mesh
   *  @param {boolean} near */
  drawFaces(pen, mesh, near) {
    const scale = (this.mesh && this.mesh.scale) || 1;
    const count = mesh.v.length / 3;
    const x = new Float64Array(count), y = new Float64Array(count), z = new Float64Array(count);
    const back = cross(this.right, this.up);
    for (let i = 0; i < count; ++i) {
      const point = [scale * mesh.v[3 * i], scale * mesh.v[3 * i + 1], scale * mesh.v[3 * i + 2]];
      [x[i], y[i]] = this.place(point);
      z[i] = this.scale() * dot(point, back);
    }
    const colour = styleColour('shape');
    const base = [1, 3, 5].map(at => parseInt(colour.slice(at, at + 2), 16));
    for (let i = 0; i < mesh.t.length; i += 3) {
      const [a, b, c] = mesh.t.slice(i, i + 3);
      const u = [x[b] - x[a], y[b] - y[a], z[b] - z[a]], v = [x[c] - x[a], y[c] - y[a], z[c] - z[a]];
      const n = unit(cross(u, v));
      // y runs down the page: a face that looks at us has a negative z here.
      if ((n[2] < 0) !== near) continue;
      const light = 0.72 + 0.5 * Math.abs(0.35 * n[0] + 0.55 * n[1] - 0.75 * n[2]) * (near ? 1 : 0.6);
      pen.fillStyle = pen.strokeStyle = 'rgb(' + base.map(k => Math.min(255, Math.round(k * light))).join(',') + ')';
      pen.lineWidth = 0.7;
      pen.beginPath();
      pen.moveTo(x[a], y[a]);
      pen.lineTo(x[b], y[b]);
      pen.lineTo(x[c], y[c]);
      pen.closePath();
      pen.fill();
      pen.stroke();
    }
  }

  /** @param {CanvasRenderingContext2D} pen @param {Item} item @param {number} alpha */
  drawItem(pen, item, alpha) {
    pen.save();
    pen.globalAlpha = alpha;
    pen.font = '13px system-ui, sans-serif';
    const label = (/** @type {string} */ text, /** @type {[number, number]} */ at) => {
      pen.lineWidth = 3;
      pen.strokeStyle = styleColour('panel');
      pen.strokeText(text, at[0] + 8, at[1] - 7);
      pen.fillStyle = styleColour('ink');
      pen.fillText(text, at[0] + 8, at[1] - 7);
    };
    if (item.kind === 'dot') {
      const at = this.place(item.at);
      pen.beginPath();
      pen.arc(at[0], at[1], item.radius, 0, 2 * Math.PI);
      pen.lineWidth = 2;
      pen.strokeStyle = item.colour;
      pen.fillStyle = item.hollow ? styleColour('panel') : item.colour;
      pen.fill();
      pen.stroke();
      if (item.label) label(item.label, at);
    } else if (item.kind === 'arrow') {
      const from = this.place(item.from), to = this.place(item.to);
      const dx = to[0] - from[0], dy = to[1] - from[1];
      const length = Math.hypot(dx, dy);
      pen.strokeStyle = pen.fillStyle = item.colour;
      pen.lineWidth = 2.5;
      pen.beginPath();
      pen.moveTo(from[0], from[1]);
      pen.lineTo(to[0], to[1]);
      pen.stroke();
      if (length > 6) {
        const [ux, uy] = [dx / length, dy / length];
        pen.beginPath();
        pen.moveTo(to[0], to[1]);
        pen.lineTo(to[0] - 9 * ux - 4 * uy, to[1] - 9 * uy + 4 * ux);
        pen.lineTo(to[0] - 9 * ux + 4 * uy, to[1] - 9 * uy - 4 * ux);
        pen.fill();
      }
      if (item.label) label(item.label, to);
    } else {
      pen.beginPath();
      item.points.forEach((point, i) => {
        const at = this.place(point);
        if (i === 0) pen.moveTo(at[0], at[1]);
        else pen.lineTo(at[0], at[1]);
      });
      pen.strokeStyle = pen.fillStyle = item.colour;
      if (item.kind === 'line') {
        pen.setLineDash(item.dash || []);
        pen.lineWidth = item.width;
        pen.stroke();
      } else {
        pen.closePath();
        pen.globalAlpha = alpha * item.alpha;
        if (item.alpha > 0) pen.fill();
        pen.globalAlpha = alpha * (item.outline || 0);
        pen.lineWidth = 1.5;
        if (item.outline) pen.stroke();
      }
    }
    pen.restore();
  }
}
