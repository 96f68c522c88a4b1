// SPDX-License-Identifier: MIT
// Jolt in WebAssembly: one body in a world of its own, asked by its narrow phase query.
import initJolt from 'jolt-physics/wasm-compat';
import { atDistance, hit, limits, miss, serve, solidOf, unsupported } from './adapter.mjs';

const Jolt = await initJolt();
const settings = new Jolt.JoltSettings();
const pairs = new Jolt.ObjectLayerPairFilterTable(1);
pairs.EnableCollision(0, 0);
const layer = new Jolt.BroadPhaseLayer(0), layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
layers.MapObjectToBroadPhaseLayer(0, layer);
settings.mObjectLayerPairFilter = pairs;
settings.mBroadPhaseLayerInterface = layers;
settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
const jolt = new Jolt.JoltInterface(settings), system = jolt.GetPhysicsSystem(), bodies = system.GetBodyInterface();
const [broad, object, body, filter] = [new Jolt.BroadPhaseLayerFilter(), new Jolt.ObjectLayerFilter(), new Jolt.BodyFilter(), new Jolt.ShapeFilter()];
const vec = ([x, y, z]) => new Jolt.Vec3(x, y, z), real = ([x, y, z]) => new Jolt.RVec3(x, y, z);
const turn = ([x, y, z, w]) => new Jolt.Quat(x, y, z, w).Normalized();

function shapeOf({ kind, sizes, points }) {
  switch (kind) {
    case 'sphere': return new Jolt.SphereShape(sizes[0]);
    case 'box': return new Jolt.BoxShape(vec(sizes), 0);
    case 'capsule': return new Jolt.CapsuleShape(sizes[1], sizes[0]);
    case 'cylinder': return new Jolt.CylinderShape(sizes[1], sizes[0], 0);
    case 'hull': {
      const hull = new Jolt.ConvexHullShapeSettings();
      hull.mMaxConvexRadius = 0;
      for (const p of points) hull.mPoints.push_back(vec(p));
      const result = hull.Create();
      return result.IsValid() ? result.Get() : null;
    }
    default: return null;
  }
}

let last = null;
serve({ name: 'jolt', version: 'jolt-physics 1.1.0',
  settings: 'float, WebAssembly; convex radii 0; CastRay, CastShape (collision tolerance 1e-5), CollideShape with a separation of 4 sizes (tolerances 1e-5)' },
(query) => {
  const solids = ['shape', 'obstacle', 'a', 'moving', 'b'].filter((key) => query[key]).map((key) => solidOf(query[key], true));
  const shapes = solids.map(shapeOf), { size, direction, tMax } = limits(query, ...solids);
  if (shapes.some((shape) => !shape)) return () => unsupported('Jolt has no such shape');
  if (last) {
    bodies.RemoveBody(last);
    bodies.DestroyBody(last);
  }
  const made = bodies.CreateBody(new Jolt.BodyCreationSettings(shapes[0], real(solids[0].at), turn(solids[0].q), Jolt.EMotionType_Static, 0));
  last = made.GetID();
  bodies.AddBody(last, Jolt.EActivation_DontActivate);
  const narrow = system.GetNarrowPhaseQuery(), way = direction.map((x) => x * tMax);
  if (query.query === 'ray') {
    const ray = new Jolt.RRayCast(real(query.ray.origin), vec(way)), how = new Jolt.RayCastSettings();
    const found = new Jolt.CastRayClosestHitCollisionCollector();
    return () => {
      found.Reset();
      narrow.CastRay(ray, how, found, broad, object, body, filter);
      return found.HadHit() ? hit(found.mHit.mFraction * tMax) : miss;
    };
  }
  // Its queries place shapes by their centre of mass, which of hulls is elsewhere.
  const b = shapes[1], at = Jolt.RMat44.prototype.sRotationTranslation(turn(solids[1].q), real(solids[1].at)).PreTranslated(b.GetCenterOfMass());
  const one = vec([1, 1, 1]), base = real([0, 0, 0]);
  if (query.query === 'shape') {
    const cast = new Jolt.RShapeCast(b, one, at, vec(way)), how = new Jolt.ShapeCastSettings();
    how.mCollisionTolerance = 1e-5;
    how.mBackFaceModeTriangles = how.mBackFaceModeConvex = Jolt.EBackFaceMode_CollideWithBackFaces;
    const found = new Jolt.CastShapeClosestHitCollisionCollector();
    return () => {
      found.Reset();
      narrow.CastShape(cast, how, base, found, broad, object, body, filter);
      return found.HadHit() ? hit(found.mHit.mFraction * tMax) : miss;
    };
  }
  const how = new Jolt.CollideShapeSettings(), isSigned = query.query === 'signed_distance';
  how.mMaxSeparationDistance = 4 * size;
  how.mCollisionTolerance = how.mPenetrationTolerance = 1e-5;
  how.mBackFaceMode = Jolt.EBackFaceMode_CollideWithBackFaces;
  const found = new Jolt.CollideShapeClosestHitCollisionCollector();
  return () => {
    found.Reset();
    narrow.CollideShape(b, one, at, how, base, found, broad, object, body, filter);
    if (!found.HadHit()) return { status: 'separated' };
    const distance = -found.mHit.mPenetrationDepth;
    return atDistance(isSigned ? distance : Math.max(0, distance));
  };
});
