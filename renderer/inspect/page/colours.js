// SPDX-License-Identifier: MIT
// Colours of numbers: viridis for amounts (van der Walt and Smith 2015), Okabe's and Ito's for kinds.

const viridis = [
  [68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142],
  [31, 158, 137], [53, 183, 121], [109, 205, 89], [180, 222, 44], [253, 231, 37],
];

/** @param {number} x from 0 to 1 @returns {number[]} */
function amountColour(x) {
  const at = Math.min(Math.max(x, 0), 1) * (viridis.length - 1);
  const i = Math.min(Math.floor(at), viridis.length - 2);
  return viridis[i].map((c, k) => Math.round(c + (at - i) * (viridis[i + 1][k] - c)));
}

/** By the place in statuses: miss, hit, inside, exhausted. */
const statusColours = [[120, 126, 134], [86, 180, 233], [230, 159, 0], [213, 94, 0]];
/** By the place in paths: filter, model, gjk, finer. */
const pathColours = [[0, 114, 178], [0, 158, 115], [230, 159, 0], [204, 121, 167]];
/** Of solvers beside each other. */
const solverColours = ['#56b4e9', '#e69f00', '#009e73', '#cc79a7'];

/** What the style sheet calls a colour. @param {string} name */
function styleColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue('--' + name).trim();
}
