// SPDX-License-Identifier: MIT
// Bounds on a number line, and how they close from step to step.

/** @param {Play} play @param {number} count @returns {string} an SVG picture */
function numberLine(play, count) {
  const width = 640, left = 12, right = width - 12;
  const [from, to] = play.range;
  const place = (/** @type {number} */ value) => left + (right - left) * Math.min(Math.max((value - from) / (to - from || 1), 0), 1);
  const rows = Math.min(count, 12);
  const height = 40 + 7 * rows;
  let svg = '<svg viewBox="0 0 ' + width + ' ' + height + '" aria-hidden="true">';
  const bar = (/** @type {number} */ k, /** @type {number} */ y, /** @type {number} */ thick, /** @type {number} */ alpha) => {
    const [lo, hi] = play.bounds(k);
    const x = place(lo);
    svg += '<rect x="' + x + '" y="' + y + '" width="' + Math.max(place(hi) - x, 2) + '" height="' + thick +
      '" fill="' + styleColour('simplex') + '" opacity="' + alpha + '"/>';
    svg += '<rect x="' + (x - 1) + '" y="' + (y - 1) + '" width="2" height="' + (thick + 2) + '" fill="' + styleColour('plane') + '"/>';
  };
  for (let i = 0; i < rows; ++i) bar(count - rows + i, 4 + 7 * i, 4, 0.35);
  const y = 8 + 7 * rows;
  bar(count, y, 8, 1);
  svg += '<line x1="' + left + '" x2="' + right + '" y1="' + (y + 13) + '" y2="' + (y + 13) + '" stroke="' + styleColour('faint') + '"/>';
  if (play.answer !== null) {
    const x = place(play.answer);
    svg += '<path d="M' + x + ' ' + (y + 13) + ' l-5 8 l10 0 z" fill="' + styleColour('point') + '"/>';
  }
  svg += '<text class="faint" x="' + left + '" y="' + (y + 27) + '">' + play.quantity + ' = ' + short(from, 5) + '</text>';
  svg += '<text class="faint" text-anchor="end" x="' + right + '" y="' + (y + 27) + '">' + short(to, 5) + '</text>';
  return svg + '</svg>';
}

/** By how much the gap shrinks each step, from its first to its last value that is neither the answer's rounding nor
 *  none. @param {(number | null)[]} values @returns {number | null} */
function rateOf(values) {
  const gaps = /** @type {number[]} */ (values.filter(v => v !== null && v > 1e-14));
  const distinct = gaps.filter((v, i) => i === 0 || v < gaps[i - 1]);
  if (distinct.length < 4) return null;
  return Math.pow(distinct[0] / distinct[distinct.length - 1], 1 / (gaps.length - 1));
}

/** @param {Play} play @param {number} count @returns {string} an SVG picture */
function closingChart(play, count) {
  const longest = Math.max(1, ...play.gaps.map(gap => gap.values.length));
  if (play.gaps.every(gap => gap.values.every(v => v === null))) return '';
  const width = 640, height = 190, left = 46, bottom = height - 24;
  const x = (/** @type {number} */ k) => left + (width - left - 100) * (longest > 1 ? k / (longest - 1) : 0.5);
  const y = (/** @type {number} */ v) => 12 + (bottom - 12) * Math.min(Math.max(-Math.log10(v) / 17, 0), 1);
  let svg = '<svg viewBox="0 0 ' + width + ' ' + height + '" aria-hidden="true">';
  for (const power of [0, -4, -8, -12, -16])
    svg += '<line x1="' + left + '" x2="' + (width - 100) + '" y1="' + y(10 ** power) + '" y2="' + y(10 ** power) + '" stroke="' + styleColour('rule') +
      '"/><text class="faint" text-anchor="end" x="' + (left - 5) + '" y="' + (y(10 ** power) + 4) + '">1e' + power + '</text>';
  svg += '<text class="faint" x="' + left + '" y="' + (height - 6) + '">step 1</text><text class="faint" text-anchor="end" x="' +
    x(longest - 1) + '" y="' + (height - 6) + '">' + (longest > 1 ? longest : '') + '</text>';
  play.gaps.forEach((gap, i) => {
    const colour = solverColours[i % solverColours.length];
    const dots = gap.values.flatMap((v, k) => v === null ? [] : [[x(k), y(v)]]);
    svg += '<polyline fill="none" stroke="' + colour + '" stroke-width="2.5" stroke-dasharray="' + (i === 0 ? '' : '6 3') + '" points="' +
      dots.map(at => at.join(',')).join(' ') + '"/>';
    for (const at of dots)
      svg += i === 0 ? '<circle r="4" cx="' + at[0] + '" cy="' + at[1] + '" fill="' + colour + '"/>'
        : '<rect x="' + (at[0] - 3.5) + '" y="' + (at[1] - 3.5) + '" width="7" height="7" fill="' + colour + '"/>';
    svg += '<text x="' + (width - 94) + '" y="' + (22 + 18 * i) + '">' + (i === 0 ? '\u25cf ' : '\u25a0 ') + escaped(gap.name) + '</text>';
  });
  svg += '<line x1="' + x(Math.max(count - 1, 0)) + '" x2="' + x(Math.max(count - 1, 0)) + '" y1="8" y2="' + bottom + '" stroke="' + styleColour('point') + '" stroke-dasharray="3 3"/>';
  return svg + '</svg>';
}

/** @param {Play} play @returns {string} */
function closingText(play) {
  const texts = play.gaps.map(gap => {
    const values = gap.values.filter(v => v !== null);
    if (values.length === 0) return '';
    const rate = rateOf(gap.values);
    return gap.name + ' takes ' + gap.values.length + (gap.values.length === 1 ? ' step' : ' steps') +
      (rate !== null && rate < 30 ? ': each leaves about 1/' + short(rate, 2) + ' of what is to go (linear convergence)'
        : gap.values.length <= 6 ? ': its model agrees with the shape where the ray arrives' : '');
  }).filter(text => text !== '');
  if (texts.length === 0) return '';
  return 'The chart shows how far the lower bound is from the answer, in radii of the shape. ' + texts.join('; ') + '.';
}
