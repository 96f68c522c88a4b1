// SPDX-License-Identifier: MIT
// The GJK distance as a replay, in space and in the plane: the origin and the set C = {x} - (A - B),
// whose point closest to the origin is as far from it as the two objects are from each other.

/** The mesh of the points a - p. @param {ShapeMesh} mesh @param {number[]} a @returns {ShapeMesh} */
function mirrored(mesh, a) {
  const scale = mesh.scale || 1;
  const turn = (/** @type {MeshData | undefined} */ part) => part && {
    v: part.v.map((c, i) => a[i % 3] / scale - c),
    t: part.t.map((_, i) => part.t[i - i % 3 + [0, 2, 1][i % 3]]),
  };
  return { rank: mesh.rank, scale, inner: turn(mesh.inner), outer: turn(mesh.outer) };
}

/** @param {DistanceReplay} of @param {ShapeMesh} obstacle A - B @param {string} names @param {boolean} flat @returns {Play} */
function distancePlay(of, obstacle, names, flat) {
  const mesh = of.mirrored_at && obstacle.scale ? mirrored(obstacle, of.mirrored_at) : null;
  const steps = of.steps;
  const outline = of.outline || [];
  const points = outline.length > 0 ? outline : steps.map(step => step.w);
  const widen = (/** @type {number[]} */ p) => p.length === 2 ? [p[0], p[1], 0] : p;
  let radius = Math.max(1e-9, ...points.map(size), ...(of.x ? [size(of.x)] : []));
  if (mesh && mesh.scale && mesh.outer)
    for (let i = 0; i < mesh.outer.v.length; i += 3)
      radius = Math.max(radius, mesh.scale * size(mesh.outer.v.slice(i, i + 3)));
  const origin = flat ? [0, 0] : [0, 0, 0];
  const nameOf = (/** @type {number[]} */ vertex, /** @type {number} */ k) => {
    for (let i = 0; i <= k; ++i) if (steps[i].w.every((c, j) => c === vertex[j])) return 'W' + i;
    return '';
  };

  /** @param {number} count @returns {Shown} */
  const show = count => {
    /** @type {Item[]} */
    const items = [];
    if (outline.length > 0)
      items.push({ kind: 'area', points: outline.map(widen), colour: styleColour('shape'), alpha: 0.25, outline: 0.9 });
    items.push({ kind: 'dot', at: widen(origin), radius: 5, colour: styleColour('ray'), hollow: true, label: 'origin' });
    /** @type {[string, string][]} */
    const formulas = [];
    let sentence = 'The origin and C, whose closest point is looked for.';
    const step = count > 0 ? steps[count - 1] : null;
    const k = count - 1;
    if (step) {
      const before = step.before.map(widen);
      if (before.length > 2)
        items.push({ kind: 'area', points: before, colour: styleColour('simplex'), alpha: 0.25, outline: 0.6 });
      for (let i = 0; i < before.length; ++i)
        for (let j = i + 1; j < before.length; ++j)
          items.push({ kind: 'line', points: [before[i], before[j]], colour: styleColour('simplex'), width: 2 });
      step.before.forEach(vertex => {
        const stays = step.after.some(other => other.every((c, j) => c === vertex[j]));
        items.push({ kind: 'dot', at: widen(vertex), radius: 4, colour: styleColour('simplex'), hollow: !stays, label: nameOf(vertex, k) });
      });
      const v = widen(step.v), w = widen(step.w), next = widen(step.v_next);
      const n = unit(v);
      if (flat) {
        const along = [-n[1] * 2 * radius, n[0] * 2 * radius, 0];
        items.push({ kind: 'line', points: [minus(w, along), plus(w, along)], colour: styleColour('plane'), width: 2, dash: [6, 4] });
      } else if (size(v) > 0) {
        const [a, b] = across(n);
        const s = 0.5 * radius;
        items.push({
          kind: 'area', colour: styleColour('plane'), alpha: 0.2, outline: 0.9,
          points: [plus(w, times(s, a)), plus(w, times(s, b)), minus(w, times(s, a)), minus(w, times(s, b))],
        });
      }
      items.push({ kind: 'arrow', from: widen(origin), to: v, colour: styleColour('plane'), label: 'v' });
      items.push({ kind: 'dot', at: w, radius: 5, colour: styleColour('point'), label: 'W' + k });
      items.push({ kind: 'dot', at: next, radius: 4, colour: styleColour('ink'), label: 'v next' });
      const vw = dot(step.v, step.w);
      const discarded = step.before.length + (step.after.length > 0 ? 1 : 0) - step.after.length;
      formulas.push(['v', vectorText(step.v) + ', |v| = ' + short(size(step.v), 9)]);
      formulas.push(['w = s_C(-v)', vectorText(step.w, 6)]);
      formulas.push(['v\u00b7w / |v|', short(vw / size(step.v), 9) + ': no point of C is closer to the origin along v']);
      formulas.push(['|v|\u00b2 - v\u00b7w', short(dot(step.v, step.v) - vw)]);
      formulas.push(['simplex', step.before.map(p => nameOf(p, k)).concat(['W' + k]).join(', ') + ' \u2192 ' +
        (step.after.map(p => nameOf(p, k)).join(', ') || 'the loop ends')]);
      formulas.push(['bounds', between(Math.max(step.lower, 0), step.upper)]);
      sentence = 'Step ' + count + ' of ' + steps.length + ': new vertex W' + k + (discarded > 0 ? ', ' + discarded + ' discarded' : '') +
        '; ' + short(Math.max(step.lower, 0), 8) + ' \u2264 distance \u2264 ' + short(step.upper, 8) + '.';
    }
    if (count === steps.length) formulas.push(['answer', of.status + ', distance ' + whole(of.distance)]);
    return { items, sentence, formulas, focus: step ? widen(step.v_next) : [0, 0, 0], focus_size: radius };
  };
  /** @param {number} count @returns {[number, number]} */
  const bounds = count => count > 0 ? [Math.max(steps[count - 1].lower, 0), steps[count - 1].upper] : [0, radius];
  return {
    mesh, radius, count: steps.length, flat, quantity: 'distance',
    look: { right: [1, 0, 0], up: flat ? [0, 1, 0] : unit([0, 0.35, 1]) },
    summary: names + (flat ? ' (their shadows on z = 0)' : '') + ': ' + of.status + ', distance ' + whole(of.distance) + ', ' +
      of.iterations + ' iterations, ' + of.supports + ' supports',
    range: [0, Math.max(radius * 1e-6, ...steps.map(step => step.upper))],
    answer: of.distance,
    columns: ['k', 'lower', 'upper', '|v|', 'simplex after'],
    rows: steps.map((step, k) => [
      String(k), whole(Math.max(step.lower, 0)), whole(step.upper), short(size(step.v)), step.after.map(p => nameOf(p, k)).join(' '),
    ]),
    show, bounds,
    gaps: [{ name: 'GJK', values: steps.map(step => Math.max((step.upper - Math.max(step.lower, 0)) / radius, 1e-17)) }],
  };
}
