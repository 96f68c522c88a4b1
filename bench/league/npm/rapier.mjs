// SPDX-License-Identifier: MIT
// Rapier, whose queries are parry's, in WebAssembly.
import RAPIER from '@dimforge/rapier3d-compat';
import { atDistance, hit, limits, miss, serve, solidOf, unsupported } from './adapter.mjs';

const vec = ([x, y, z]) => ({ x, y, z });
const turn = ([x, y, z, w]) => ({ x, y, z, w });
await RAPIER.init();

function shapeOf({ kind, sizes, points }) {
  const flat = points && new Float32Array(points.flat());
  switch (kind) {
    case 'sphere': return new RAPIER.Ball(sizes[0]);
    case 'box': return new RAPIER.Cuboid(...sizes);
    case 'capsule': return new RAPIER.Capsule(sizes[1], sizes[0]);
    case 'cylinder': return new RAPIER.Cylinder(sizes[1], sizes[0]);
    case 'cone': return new RAPIER.Cone(sizes[1], sizes[0]);
    case 'segment': return new RAPIER.Segment(vec(points[0]), vec(points[1]));
    case 'triangle': return new RAPIER.Triangle(...points.map(vec));
    case 'hull': return new RAPIER.ConvexPolyhedron(flat, null);
    default: return null;
  }
}

serve({ name: 'rapier', version: '@dimforge/rapier3d-compat ' + RAPIER.version(),
  settings: 'float, WebAssembly; castRay (solid), castShape (target distance 0, stops at penetration), contactShape with a prediction of 4 sizes' },
(query) => {
  const solids = ['shape', 'obstacle', 'a', 'moving', 'b'].filter((key) => query[key]).map((key) => solidOf(query[key], true));
  const shapes = solids.map(shapeOf), { size, direction, tMax } = limits(query, ...solids);
  if (shapes.some((shape) => !shape)) return () => unsupported('Rapier has no such shape');
  const [a, b] = shapes, [pa, pb] = solids.map((s) => vec(s.at)), [qa, qb] = solids.map((s) => turn(s.q));
  if (query.query === 'ray') {
    const ray = new RAPIER.Ray(vec(query.ray.origin), vec(query.ray.direction));
    return () => {
      const t = a.castRay(ray, pa, qa, tMax, true);
      return t >= 0 ? hit(t) : miss;
    };
  }
  if (query.query === 'shape') {
    const still = vec([0, 0, 0]), d = vec(direction);
    return () => {
      const found = a.castShape(pa, qa, still, b, pb, qb, d, 0, tMax, true);
      return found ? hit(found.time_of_impact) : miss;
    };
  }
  const isSigned = query.query === 'signed_distance';
  return () => {
    const contact = a.contactShape(pa, qa, b, pb, qb, 4 * size);
    if (!contact) return { status: 'failed', why: 'no contact' };
    return atDistance(isSigned ? contact.distance : Math.max(0, contact.distance));
  };
});
