// SPDX-License-Identifier: MIT
// The picture and the maps of what its pixels cost: shown, magnified, pointed at.

/** What can be shown, and how: of the picture's planes, by the number of the solver. */
const maps = [
  { name: 'picture', text: 'picture', kind: 'picture', plane: '' },
  { name: 'iterations', text: 'iterations', kind: 'amount', plane: 'ray_iterations', unit: 'solver iterations per ray' },
  { name: 'supports', text: 'supports', kind: 'amount', plane: 'ray_supports', unit: 'support points per ray' },
  { name: 'nodes', text: 'nodes', kind: 'amount', plane: 'ray_nodes', unit: 'nodes visited per ray' },
  { name: 'casts', text: 'casts', kind: 'amount', plane: 'ray_casts', unit: 'shapes and triangles cast at per ray' },
  { name: 'time', text: 'nanoseconds', kind: 'time', plane: 'ray_time', unit: 'nanoseconds per ray' },
  { name: 'path', text: 'which path answered', kind: 'path', plane: 'ray_path', unit: 'last stage asked' },
  { name: 'status', text: 'status', kind: 'status', plane: 'status', unit: 'answer of the cast that is shown' },
  { name: 'replayable', text: 'what can be replayed here', kind: 'replayable', plane: '', unit: '' },
];

/** In the place of a triangle's number: of no mesh. */
const noTriangle = 4294967295;

class Picture {
  /** @param {HTMLCanvasElement} canvas @param {View} view @param {About} about */
  constructor(canvas, view, about) {
    this.canvas = canvas;
    this.view = view;
    this.about = about;
    /** @type {CanvasImageSource | null} */
    this.photo = null;
    /** What the photo shows, in pixels of the view. */
    this.photo_window = [0, 0, view.width, view.height];
    this.map = maps[0];
    this.solver = 0;
    /** @type {HTMLCanvasElement | null} */
    this.heat = null;
    this.zoom = 1;
    this.centre = [view.width / 2, view.height / 2];
    /** @type {[number, number]} */
    this.pixel = [view.width >> 1, view.height >> 1];
    /** The point whose cast is replayed. @type {[number, number] | null} */
    this.chosen = null;
    /** @type {Set<string>} */
    this.replayable = new Set();
    this.names = true;
    /** Where the objects' names stand: the middle of their pixels. @type {{name: string, x: number, y: number}[]} */
    this.places = [];
    this.findPlaces();
  }

  /** Of each object that covers enough pixels for a name. */
  findPlaces() {
    const { planes, names, width, height } = this.view;
    /** @type {Map<number, number[]>} */
    const sums = new Map();
    for (let i = 0; i < width * height; ++i) {
      const status = this.about.statuses[planes.status[i]];
      if (status !== 'hit' && status !== 'inside') continue;
      const sum = sums.get(planes.object[i]) || [0, 0, 0];
      sum[0] += 1;
      sum[1] += i % width;
      sum[2] += Math.floor(i / width);
      sums.set(planes.object[i], sum);
    }
    this.places = [...sums].filter(([, sum]) => sum[0] > 60).slice(0, 200).map(([object, sum]) =>
      ({ name: names[object] || '', x: sum[1] / sum[0], y: sum[2] / sum[0] }));
  }

  /** Pixels of the page a pixel of the picture. */
  scale() {
    return this.zoom * this.canvas.clientWidth / this.view.width;
  }

  /** Where the page shows a point of the picture. @param {number} x @param {number} y */
  toPage(x, y) {
    const s = this.scale();
    return [this.canvas.clientWidth / 2 + (x - this.centre[0]) * s, this.canvas.clientHeight / 2 + (y - this.centre[1]) * s];
  }

  /** @param {number} px @param {number} py */
  toPicture(px, py) {
    const s = this.scale();
    return [this.centre[0] + (px - this.canvas.clientWidth / 2) / s, this.centre[1] + (py - this.canvas.clientHeight / 2) / s];
  }

  /** Magnifies, a point of the page staying in its place. @param {number} factor @param {number} px @param {number} py */
  magnify(factor, px = this.canvas.clientWidth / 2, py = this.canvas.clientHeight / 2) {
    const [x, y] = this.toPicture(px, py);
    this.zoom = Math.min(Math.max(this.zoom * factor, 1), 64);
    const s = this.scale();
    this.moveTo(x - (px - this.canvas.clientWidth / 2) / s, y - (py - this.canvas.clientHeight / 2) / s);
  }

  /** @param {number} x @param {number} y */
  moveTo(x, y) {
    const halfWidth = this.canvas.clientWidth / 2 / this.scale(), halfHeight = this.canvas.clientHeight / 2 / this.scale();
    const within = (/** @type {number} */ at, /** @type {number} */ half, /** @type {number} */ most) =>
      2 * half >= most ? most / 2 : Math.min(Math.max(at, half), most - half);
    this.centre = [within(x, halfWidth, this.view.width), within(y, halfHeight, this.view.height)];
    this.draw();
  }

  /** @returns {number} the place of a pixel in the planes */
  index(x = this.pixel[0], y = this.pixel[1]) {
    return y * this.view.width + x;
  }

  /** @param {string} name */
  plane(name) {
    return this.view.planes[name + ':' + this.solver] || this.view.planes[name];
  }

  makeHeat() {
    this.heat = null;
    if (this.map.kind === 'picture' || this.map.kind === 'replayable') return;
    const { width, height } = this.view;
    const heat = document.createElement('canvas');
    heat.width = width;
    heat.height = height;
    const pen = heat.getContext('2d');
    if (!pen) return;
    const image = pen.createImageData(width, height);
    const plane = this.plane(this.map.plane);
    const [least, most] = this.extremes();
    for (let i = 0; i < width * height; ++i) {
      const colour = this.map.kind === 'path' ? pathColours[plane[i]]
        : this.map.kind === 'status' ? statusColours[plane[i]]
          : amountColour((plane[i] - least) / (most - least || 1));
      image.data.set([colour[0], colour[1], colour[2], 255], 4 * i);
    }
    pen.putImageData(image, 0, 0);
    this.heat = heat;
  }

  /** The scale's ends: of times without the few that something else on the machine took. */
  extremes() {
    const plane = this.plane(this.map.plane);
    if (this.map.kind === 'time') {
      const sorted = Uint8Array.from(/** @type {Uint8Array} */ (plane)).sort();
      return [sorted[Math.floor(0.002 * sorted.length)], sorted[Math.floor(0.998 * sorted.length)]];
    }
    let most = 1;
    for (let i = 0; i < plane.length; ++i) most = Math.max(most, plane[i]);
    return [0, most];
  }

  draw() {
    const { canvas, view } = this;
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth, height = Math.max(1, Math.round(width * view.height / view.width));
    canvas.style.height = height + 'px';
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const pen = canvas.getContext('2d');
    if (!pen) return;
    pen.scale(ratio, ratio);
    pen.imageSmoothingEnabled = this.scale() < 1;
    const put = (/** @type {CanvasImageSource} */ image, /** @type {number[]} */ window) => {
      const [x0, y0] = this.toPage(window[0], window[1]), [x1, y1] = this.toPage(window[2], window[3]);
      pen.drawImage(image, x0, y0, x1 - x0, y1 - y0);
    };
    const all = [0, 0, view.width, view.height];
    if (this.heat) put(this.heat, all);
    else if (this.photo) put(this.photo, this.photo_window);
    const s = this.scale();
    if (this.map.kind === 'replayable') {
      pen.fillStyle = 'rgba(0,0,0,0.45)';
      pen.fillRect(0, 0, width, height);
      pen.fillStyle = '#f0e442';
      for (const key of this.replayable) {
        const [x, y] = key.split(',').map(Number);
        const [px, py] = this.toPage(x + 0.5, y + 0.5);
        const side = Math.max(1.5, s);
        pen.fillRect(px - side / 2, py - side / 2, side, side);
      }
    }
    const mark = (/** @type {[number, number]} */ pixel, /** @type {string} */ colour) => {
      const [px, py] = this.toPage(pixel[0], pixel[1]);
      const half = Math.max(5, Math.min(s / 2 + 2, 14));
      for (const [thick, c] of /** @type {[number, string][]} */ ([[4, '#000000'], [2, colour]])) {
        pen.lineWidth = thick;
        pen.strokeStyle = c;
        pen.strokeRect(px - half, py - half, 2 * half, 2 * half);
      }
    };
    if (this.names) {
      pen.font = '12px system-ui, sans-serif';
      pen.textAlign = 'center';
      pen.lineWidth = 3;
      // Names that would lie over others stand below them.
      /** @type {{left: number, right: number, y: number}[]} */
      const taken = [];
      for (const place of this.places) {
        const [px, middle] = this.toPage(place.x + 0.5, place.y + 0.5);
        const half = pen.measureText(place.name).width / 2 + 2;
        let py = middle;
        while (taken.some(other => other.left < px + half && px - half < other.right && Math.abs(other.y - py) < 14)) py += 4;
        taken.push({ left: px - half, right: px + half, y: py });
        pen.strokeStyle = 'rgba(0,0,0,0.75)';
        pen.strokeText(place.name, px, py + 4);
        pen.fillStyle = '#ffffff';
        pen.fillText(place.name, px, py + 4);
      }
    }
    mark([this.pixel[0] + 0.5, this.pixel[1] + 0.5], '#ffffff');
    if (this.chosen) mark(this.chosen, '#f0e442');
  }

  /** What the legend says, as HTML; a bar of colours is drawn into the canvas in it. */
  legend() {
    const kinds = (/** @type {string[]} */ names, /** @type {number[][]} */ colours) =>
      names.map((name, i) => '<span><i style="background:rgb(' + colours[i].join(',') + ')"></i>' + name + '</span>').join('');
    switch (this.map.kind) {
      case 'picture':
        return '';
      case 'path':
        return kinds(this.about.paths, pathColours) + '<span>' + this.map.unit + '</span>';
      case 'status':
        return kinds(this.about.statuses, statusColours) + '<span>' + this.map.unit + '</span>';
      case 'replayable':
        return '<span><i style="background:#f0e442"></i>' + this.replayable.size + ' pixels</span>';
      default: {
        const [least, most] = this.extremes();
        const text = (/** @type {number} */ v) => this.map.kind === 'time' ? short(nanosecondsOf(v), 2) : String(v);
        return '<span>' + text(least) + '</span><canvas width="180" height="1" aria-hidden="true"></canvas><span>' + text(most) + '</span><span>' +
          (this.map.kind === 'time' ? this.map.unit + ', logarithmic' : this.map.unit) + '</span>';
      }
    }
  }

  /** What is known of a pixel. @param {number} x @param {number} y */
  answer(x, y) {
    const i = this.index(x, y);
    const { planes, names } = this.view;
    const status = this.about.statuses[planes.status[i]];
    const found = status === 'hit' || status === 'inside';
    const below = lengthOf(planes.below[i]), above = lengthOf(planes.above[i]);
    const cost = (/** @type {string} */ name) => this.plane('ray_' + name)[i];
    const triangle = found && planes.triangle && planes.triangle[i] !== noTriangle ? ', triangle ' + planes.triangle[i] : '';
    return {
      object: planes.object[i] > 0 ? names[planes.object[i]] + triangle : '',
      status,
      t: found ? planes.t[i] : null,
      bounds: found ? 't - ' + short(below, 2) + ' \u2026 t + ' + short(above, 2) : '-',
      normal: directionOf(planes.normal_u[i], planes.normal_v[i]),
      iterations: this.plane('iterations')[i],
      supports: this.plane('supports')[i],
      cost: cost('iterations') + ' iterations, ' + cost('supports') + ' supports, ' + cost('nodes') + ' nodes, ' + cost('casts') + ' casts, ' +
        short(nanosecondsOf(cost('time')), 2) + ' ns, answered by: ' + this.about.paths[cost('path')],
    };
  }
}
