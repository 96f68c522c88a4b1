// SPDX-License-Identifier: MIT
// Numbers as text, and small vectors.

/** @param {number | null | undefined} x @param {number} digits */
function short(x, digits = 6) {
  if (x === null || x === undefined || Number.isNaN(x)) return '-';
  if (!Number.isFinite(x)) return x > 0 ? '\u221e' : '-\u221e';
  return String(Number(x.toPrecision(digits)));
}

/** All digits. @param {number | null | undefined} x */
function whole(x) {
  return x === null || x === undefined ? '-' : Number.isFinite(x) ? String(x) : short(x);
}

/** @param {number[]} v @param {number} digits */
function vectorText(v, digits = 4) {
  return '(' + v.map(x => short(x, digits)).join(', ') + ')';
}

/** @param {string} text */
function escaped(text) {
  return text.replace(/[&<>"]/g, c => '&#' + c.charCodeAt(0) + ';');
}

/** @param {number[]} a @param {number[]} b */
function plus(a, b) {
  return a.map((x, i) => x + b[i]);
}

/** @param {number[]} a @param {number[]} b */
function minus(a, b) {
  return a.map((x, i) => x - b[i]);
}

/** @param {number} f @param {number[]} a */
function times(f, a) {
  return a.map(x => f * x);
}

/** @param {number[]} a @param {number[]} b */
function dot(a, b) {
  return a.reduce((sum, x, i) => sum + x * b[i], 0);
}

/** @param {number[]} a @param {number[]} b */
function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** @param {number[]} a */
function size(a) {
  return Math.hypot(...a);
}

/** Zero stays zero. @param {number[]} a */
function unit(a) {
  const length = size(a);
  return length > 0 ? times(1 / length, a) : a;
}

/** Two directions square to one and to each other. @param {number[]} n @returns {[number[], number[]]} */
function across(n) {
  const least = n.map(Math.abs).indexOf(Math.min(...n.map(Math.abs)));
  const axis = [0, 1, 2].map(i => (i === least ? 1 : 0));
  const u = unit(cross(n, axis));
  return [u, unit(cross(n, u))];
}

/** Bounds as text: the digits that they have in common, and then the others. @param {number} lo @param {number} hi */
function between(lo, hi) {
  return '[' + whole(lo) + ', ' + whole(hi) + ']';
}

/** A pixel's whole numbers, or those of a point within it. @param {number[]} at @param {string} comma */
function placeText(at, comma) {
  const isCentre = at.every(c => c % 1 === 0.5);
  return at.map(c => isCentre ? String(Math.floor(c)) : String(Number(c.toFixed(4)))).join(comma);
}
