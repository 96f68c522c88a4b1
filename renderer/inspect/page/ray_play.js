// SPDX-License-Identifier: MIT
// A ray cast as a replay: its items in space, its sentences and formulas. All numbers come from the
// program; what is added up here is the ray's point at lambda and t at lambda.

const caseTexts = [
  '',
  'v\u00b7r < 0: nothing before the plane can be hit, a lower bound',
  'v\u00b7r > 0: nothing behind the plane can be hit, an upper bound',
  'v\u00b7r = 0: the plane runs along the ray and clips nothing, or all of it',
];

/** The radius of what is seen at first: a shape, or a triangle and some of its mesh. @param {ShapeMesh} mesh @param {number} R */
function radiusSeen(mesh, R) {
  return mesh.around ? Math.max(R, Math.min(5000 * mesh.around.scale, 4 * R)) : R;
}

/** A triangle's corners. @param {MeshData} mesh @param {number} scale */
function cornersOf(mesh, scale) {
  return [0, 3, 6].map(i => times(scale, mesh.v.slice(i, i + 3)));
}

/** The direction square to a ray in which a triangle of a mesh faces it most; nothing if it faces the ray straight, or
 *  for other shapes. @param {ShapeMesh} mesh @param {number[]} ray @returns {number[] | null} */
function outwardOf(mesh, ray) {
  if (!mesh.around || !mesh.inner) return null;
  const [a, b, c] = cornersOf(mesh.inner, 1);
  const n = unit(cross(minus(b, a), minus(c, a)));
  const along = dot(n, ray);
  const aside = times(along > 0 ? -1 : 1, minus(n, times(along, ray)));
  return size(aside) > 1e-3 ? unit(aside) : null;
}

/** @param {Cast} cast @param {ShapeMesh} mesh @param {string} solver @param {{name: string, cast: Cast}[]} others
 *  @param {string} what @param {string} path what answered in the picture, or nothing @returns {Play} */
function rayPlay(cast, mesh, solver, others, what, path) {
  const R = cast.radius > 0 ? cast.radius : 1;
  const [base, shift, perLength] = cast.t_of;
  const tOf = (/** @type {number | null} */ lambda) => lambda === null ? Infinity : base + (shift + lambda * perLength);
  const at = (/** @type {number} */ lambda) => plus(cast.s, times(lambda, cast.r));
  const seen = radiusSeen(mesh, R);
  const begin = Math.max(cast.lambda[0] === null ? -Infinity : cast.lambda[0], -1.7 * seen);
  const end = Math.min(cast.lambda[1] === null ? Infinity : cast.lambda[1], 1.7 * seen);
  const steps = cast.steps;
  const found = cast.t !== undefined;
  const lambdaOf = (/** @type {number} */ t) => ((t - base) - shift) / perLength;
  const hitLambda = found ? lambdaOf(/** @type {number} */ (cast.t)) : null;
  const clamp = (/** @type {number | null} */ lambda, /** @type {number} */ otherwise) =>
    lambda === null ? otherwise : Math.min(Math.max(lambda, begin), end);

  const ray = unit(cast.r);
  const outward = outwardOf(mesh, ray);
  const up = outward || unit(size(cast.s) > 1e-6 * R ? cast.s : across(ray)[0]);
  const side = unit(cross(ray, up));
  // Obliquely from the side, the ray from left to right; of a mesh from without.
  const right = unit(plus(times(0.92, ray), times(0.39, side)));
  const tilted = unit(plus(up, times(outward ? -0.5 : 0.3, side)));
  const look = { right, up: unit(minus(tilted, times(dot(tilted, right), right))) };

  /** @param {CastStep} step */
  const plane = step => {
    const [u, v] = across(unit(step[5]));
    const p = step[6], a = 0.75 * R;
    return [plus(p, times(a, u)), plus(p, times(a, v)), minus(p, times(a, u)), minus(p, times(a, v))];
  };
  const vertex = (/** @type {number | number[]} */ of) => typeof of === 'number' ? steps[of][6] : of;

  /** @param {number} count how many steps are shown @param {boolean} earlier @returns {Shown} */
  const show = (count, earlier) => {
    /** @type {Item[]} */
    const items = [];
    const step = count > 0 ? steps[count - 1] : null;
    const k = count - 1;
    const lower = step ? clamp(step[3], begin) : begin;
    const upper = step ? clamp(step[4], end) : end;
    items.push({ kind: 'line', points: [at(begin), at(end)], colour: styleColour('faint'), width: 1, dash: [4, 4] });
    items.push({ kind: 'line', points: [at(lower), at(Math.max(lower, upper))], colour: styleColour('ray'), width: 3.5 });
    if (mesh.around && mesh.inner)
      items.push({ kind: 'area', points: cornersOf(mesh.inner, mesh.scale || 1), colour: styleColour('upper'), alpha: 0.4, outline: 1 });
    if (earlier)
      for (let i = 0; i < k; ++i) {
        if (size(steps[i][5]) > 0)
          items.push({ kind: 'area', points: plane(steps[i]), colour: styleColour('plane'), alpha: 0, outline: 0.16 });
        items.push({ kind: 'dot', at: steps[i][6], radius: 2.5, colour: styleColour('point'), label: k < 8 ? 'p' + i : '' });
      }
    /** @type {[string, string][]} */
    const formulas = [];
    let sentence = 'The ray, before anything is asked of the shape.';
    let focus = [0, 0, 0], focusSize = R;
    if (step) {
      const [lambda, which, clip, , , v, p, w, simplex] = step;
      const corners = simplex.map(vertex);
      if (corners.length > 1) {
        for (let i = 0; i < corners.length; ++i)
          for (let j = i + 1; j < corners.length; ++j)
            items.push({ kind: 'line', points: [corners[i], corners[j]], colour: styleColour('simplex'), width: 2 });
        if (corners.length === 3)
          items.push({ kind: 'area', points: corners, colour: styleColour('simplex'), alpha: 0.35, outline: 0 });
      }
      for (const corner of corners)
        items.push({ kind: 'dot', at: corner, radius: 4, colour: styleColour('simplex') });
      const x = at(lambda);
      if (size(v) > 0) {
        items.push({ kind: 'area', points: plane(step), colour: styleColour('plane'), alpha: 0.2, outline: 0.9 });
        items.push({ kind: 'arrow', from: p, to: plus(p, times(0.35 * R, unit(v))), colour: styleColour('plane'), label: 'v' });
      }
      items.push({ kind: 'dot', at: p, radius: 5, colour: styleColour('point'), label: 'p' + k });
      items.push({ kind: 'line', points: [p, plus(p, w)], colour: styleColour('point'), width: 1.5, dash: [5, 3] });
      items.push({ kind: 'dot', at: x, radius: 4.5, colour: styleColour('ray'), hollow: true, label: 'x' });
      const vw = dot(v, w), vr = dot(v, cast.r);
      focus = x;
      focusSize = Math.min(R, Math.max(1.5 * size(w), 1e-6 * R));
      formulas.push(['v', vectorText(v) + ', |v| = ' + short(size(v))]);
      formulas.push(['p = s(v)', vectorText(p, 6)]);
      formulas.push(['w = x - p', vectorText(w) + ', |w| = ' + short(size(w))]);
      formulas.push(['v\u00b7w', short(vw) + (vw > 0 ? ' > 0: the plane keeps x off the shape' : ' \u2264 0: the plane does not keep x off the shape')]);
      formulas.push(['v\u00b7r', short(vr) + '; case ' + which + ', ' + caseTexts[which]]);
      formulas.push(['\u03bb_clip = v\u00b7(p - s) / v\u00b7r', clip === null ? '-' : whole(clip) + ', t = ' + whole(tOf(clip))]);
      formulas.push(['\u03bb', whole(lambda) + ', t = ' + whole(tOf(lambda))]);
      formulas.push(['x = s + \u03bb r', vectorText(x, 6)]);
      formulas.push(['[t_lo, t_hi]', between(tOf(step[3]), tOf(step[4])) + ', width ' + short(tOf(step[4]) - tOf(step[3]), 3)]);
      formulas.push(['simplex', simplex.length === 0 ? 'none: this stage keeps a model of the shape, made of what its support points tell'
        : simplex.map(of => typeof of === 'number' ? 'p' + of : vectorText(of)).join(', ')]);
      const before = k > 0 ? steps[k - 1][3] : cast.lambda[0];
      const advanced = step[3] !== null && before !== null && step[3] > before;
      sentence = 'Step ' + count + ' of ' + steps.length + ': support point p' + k + '; ' +
        (which === 1 ? (advanced ? 'its plane moves the lower bound to t = ' + short(tOf(step[3]), 8)
          : 'its plane lies before what is known: the lower bound stays')
          : which === 2 ? 'its plane bounds t from above, t \u2264 ' + short(tOf(step[4]), 8) : 'its plane runs along the ray') +
        (step[3] !== null && step[4] !== null && step[3] > step[4] ? '; nothing of the ray is left, a miss' : '') + '.';
    }
    if (hitLambda !== null && count === steps.length) {
      items.push({ kind: 'dot', at: at(hitLambda), radius: 6, colour: styleColour('ink'), label: cast.status });
      formulas.push(['answer', cast.status + ', t = ' + whole(cast.t) + ' in ' +
        between(cast.t_lo === null ? -Infinity : /** @type {number} */ (cast.t_lo), cast.t_hi === null ? Infinity : /** @type {number} */ (cast.t_hi)) +
        ', answered by: ' + cast.path]);
    } else if (count === steps.length) {
      formulas.push(['answer', cast.status + ', answered by: ' + cast.path]);
    }
    return { items, sentence, formulas, focus, focus_size: focusSize };
  };
  /** @param {number} count @returns {[number, number]} */
  const bounds = count => {
    const step = count > 0 ? steps[count - 1] : null;
    // In the end it is what the answer claims, which knows more than single planes.
    const isProven = count === steps.length && found && cast.t_lo !== null && cast.t_hi !== null;
    return isProven ? [/** @type {number} */ (cast.t_lo), /** @type {number} */ (cast.t_hi)]
      : [step ? tOf(step[3]) : tOf(begin), step ? tOf(step[4]) : tOf(end)];
  };

  /** How far the lower bound is from the answer, in radii. @param {Cast} of */
  const gapsOf = of => {
    const [b, s, l] = of.t_of;
    return of.steps.map(step => {
      if (of.t === undefined || step[3] === null) return null;
      const answer = ((of.t - b) - s) / l;
      return Math.max((answer - step[3]) / R, 1e-17);
    });
  };
  return {
    mesh, radius: seen, count: steps.length, flat: false, look, quantity: 't',
    summary: what + ': ' + cast.status + (found ? ', t = ' + whole(cast.t) : '') + ', ' + cast.iterations +
      ' iterations, ' + cast.supports + ' supports, by ' + solver +
      (mesh.around ? '. In the picture the mesh\u2019s BVH and exact tests at triangles answered it, without a step; this is a cast at the triangle alone.' +
        (mesh.around.coarse ? ' The mesh around it is drawn coarsely.' : '') :
        path === 'filter' ? '. In the picture the filter answered it, a closed form, without a step; this is the stage behind it' : '') +
      (steps.length === 0 ? '. No support point was asked for: a bound of the shape told, or a closed form.' : ''),
    range: [tOf(begin), tOf(end)],
    answer: found ? /** @type {number} */ (cast.t) : null,
    columns: ['k', 'case', 't_clip', 't_lo', 't_hi', '|v|', '|w|', 'simplex'],
    rows: steps.map((step, k) => [
      String(k), String(step[1]), step[2] === null ? '-' : whole(tOf(step[2])), whole(tOf(step[3])), whole(tOf(step[4])),
      short(size(step[5])), short(size(step[7])), step[8].map(of => typeof of === 'number' ? 'p' + of : '\u2022').join(' '),
    ]),
    show, bounds,
    gaps: others.map(other => ({ name: other.name, values: gapsOf(other.cast) })),
  };
}
