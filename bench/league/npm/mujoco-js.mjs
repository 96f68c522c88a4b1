// SPDX-License-Identifier: MIT
// MuJoCo 3 in WebAssembly: rays of its shapes, distances by mj_geomDistance.
import loadMujoco from 'mujoco-js';
import { atDistance, hit, limits, miss, serve, solidOf, unsupported } from './adapter.mjs';

const mujoco = await loadMujoco({ print: () => {}, printErr: () => {} });
mujoco.FS.mkdir('/model');
mujoco.FS.mount(mujoco.MEMFS, { root: '.' }, '/model');
const GEOMS = { sphere: 2, capsule: 3, ellipsoid: 4, cylinder: 5, box: 6 };

function geomOf(solid, mesh) {
  const three = (numbers) => [...numbers, 0, 0, 0].slice(0, 3).map((x) => x ?? 0).join(' ');
  if (GEOMS[solid.kind]) return [`type="${solid.kind}" size="${three(solid.sizes)}"`, ''];
  if (solid.kind !== 'hull') return null;
  return [`type="mesh" mesh="${mesh}"`, `<mesh name="${mesh}" vertex="${solid.points.flat().join(' ')}"/>`];
}

let old = [];
serve({ name: 'mujoco-js', version: `mujoco-js 0.0.7, MuJoCo ${mujoco.mj_versionString()}`,
  settings: 'double, WebAssembly; mju_rayGeom, mj_geomDistance up to 4 sizes; ccd_tolerance 1e-9' },
(query) => {
  for (const thing of old) thing.delete();
  old = [];
  const solids = ['shape', 'a', 'b'].filter((key) => query[key]).map((key) => solidOf(query[key], false));
  if (query.query === 'shape') return () => unsupported('MuJoCo casts no shapes');
  const { size, tMax } = limits(query, ...solids);
  if (query.query === 'ray') {
    const [solid] = solids, type = GEOMS[solid.kind];
    if (!type) return () => unsupported('a mesh, or no shape of MuJoCo');
    const { origin, direction } = query.ray, sizes = [...solid.sizes, 0, 0].slice(0, 3).map((x) => x ?? 0), rows = solid.rows.flat();
    return () => {
      const t = mujoco.mju_rayGeom(solid.at, rows, sizes, origin, direction, type);
      return t >= 0 && t <= tMax ? hit(t) : miss;
    };
  }
  const geoms = solids.map((solid, i) => geomOf(solid, 'ab'[i]));
  if (geoms.some((geom) => !geom)) return () => unsupported('MuJoCo has no such shape');
  const bodies = geoms.map(([geom], i) => {
    const [x, y, z, w] = solids[i].q;
    return `<body pos="${solids[i].at.join(' ')}" quat="${w} ${x} ${y} ${z}"><freejoint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><geom ${geom}/></body>`;
  });
  mujoco.FS.writeFile('/model/m.xml', `<mujoco><option ccd_tolerance="1e-9"/><asset>${geoms.map((g) => g[1]).join('')}</asset><worldbody>${bodies.join('')}</worldbody></mujoco>`);
  const model = mujoco.MjModel.loadFromXML('/model/m.xml'), data = new mujoco.MjData(model);
  old = [data, model];
  mujoco.mj_forward(model, data);
  const isSigned = query.query === 'signed_distance', fromTo = new Float64Array(6);
  return () => {
    const distance = mujoco.mj_geomDistance(model, data, 0, 1, 4 * size, fromTo);
    return atDistance(isSigned ? distance : Math.max(0, distance));
  };
});
