// SPDX-License-Identifier: MIT
// What the program wrote into the page, read.

/** @param {string} id @returns {any} */
function element(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error('the page has no ' + id);
  return found;
}

/** @param {string} text @returns {Uint8Array} */
function bytesOf(text) {
  const characters = atob(text.trim());
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
  return bytes;
}

/** @param {Uint8Array} bytes @returns {Promise<ArrayBuffer>} */
function unpacked(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/** The kinds of numbers, as renderer/inspect/planes.h names them. */
const planeTypes = {
  f64: Float64Array,
  u8: Uint8Array,
  u16: Uint16Array,
  i16: Int16Array,
  u32: Uint32Array,
};

/** @param {PackedView} packed @returns {Promise<View>} */
async function viewOf(packed) {
  const [width, height] = packed.resolution;
  const count = width * height;
  const bytes = new Uint8Array(await unpacked(bytesOf(packed.bytes)));
  /** @type {Record<string, Plane>} */
  const planes = {};
  let begin = 0;
  for (const [name, type] of packed.planes) {
    const plane = new planeTypes[/** @type {keyof typeof planeTypes} */ (type)](count);
    const size = plane.BYTES_PER_ELEMENT;
    const into = new Uint8Array(plane.buffer);
    for (let k = 0; k < size; ++k)
      for (let i = 0; i < count; ++i) into[i * size + k] = bytes[begin + k * count + i];
    planes[name] = plane;
    begin += size * count;
  }
  return { width, height, solvers: packed.solvers, names: packed.names, planes };
}

/** A length of 16 bits: the upper half of a float. @param {number} bits */
function lengthOf(bits) {
  return new Float32Array(new Uint32Array([bits << 16 >>> 0]).buffer)[0];
}

/** @param {number} code */
function nanosecondsOf(code) {
  return Math.pow(2, code / 12);
}

/** A direction of twice 16 bits. @param {number} u @param {number} v @returns {number[]} */
function directionOf(u, v) {
  if (v === -32768) return [0, 0, 0];
  let x = u / 32767, y = v / 32767;
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) {
    const folded = (1 - Math.abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - Math.abs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/** All that can be replayed. */
class Replays {
  constructor() {
    /** @type {Map<number, ShapeMesh>} */
    this.shapes = new Map();
    /** Rays by solver, under "x,y" of their pixel. @type {Map<string, RayReplay[]>} */
    this.rays = new Map();
    /** @type {PairReplay[]} */
    this.pairs = [];
  }

  /** @param {string} text lines of JSON @returns {RayReplay[]} the rays among them, by solver */
  add(text) {
    /** @type {RayReplay[]} */
    const added = [];
    /** @type {Map<number, ShapeMesh>} */
    const shapes = new Map();
    /** @type {Map<number, Body>} */
    const bodies = new Map();
    for (const line of text.split('\n')) {
      if (line === '') continue;
      /** @type {Line} */
      const item = JSON.parse(line);
      if (item.kind === 'shape') {
        const around = item.mesh.body === undefined ? undefined : bodies.get(item.mesh.body);
        shapes.set(item.shape, { ...item.mesh, around });
      } else if (item.kind === 'body') {
        bodies.set(item.body, item.mesh);
      } else if (item.kind === 'pair') {
        const known = this.pairs.findIndex(p => p.a === item.pair.a && p.b === item.pair.b);
        if (known < 0) this.pairs.push(item.pair);
      } else {
        const mesh = shapes.get(item.shape) || { rank: -1 };
        const key = Math.floor(item.at[0]) + ',' + Math.floor(item.at[1]);
        const rays = this.rays.get(key) || [];
        rays[item.solver] = { ...item, mesh };
        added[item.solver] = rays[item.solver];
        this.rays.set(key, rays);
      }
    }
    return added;
  }

  /** The pixel closest to one whose casts are here, if it is not too far away to be meant.
   *  @param {number} x @param {number} y @returns {[number, number] | null} */
  nearest(x, y) {
    const furthest = 40;
    let best = null, least = furthest * furthest;
    for (const key of this.rays.keys()) {
      const [px, py] = key.split(',').map(Number);
      const distance = (px - x) ** 2 + (py - y) ** 2;
      if (distance < least) {
        least = distance;
        best = /** @type {[number, number]} */ ([px, py]);
      }
    }
    return best;
  }

  /** The pixel whose cast took most iterations by the last solver and hits. @returns {number[] | null} */
  hardest() {
    let best = null, most = -1;
    for (const [key, rays] of this.rays) {
      const last = rays[rays.length - 1];
      if (!last || last.cast.status !== 'hit' || last.cast.iterations <= most) continue;
      most = last.cast.iterations;
      best = key.split(',').map(Number);
    }
    return best;
  }
}
