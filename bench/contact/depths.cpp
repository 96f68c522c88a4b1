// SPDX-License-Identifier: MIT
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <ccd/ccd.h>

#include <algorithm>

#include "bench/contact/peers.h"
#include "core/pair_distance/signed_distance.h"

namespace minkray::bench {
namespace {

/// A shape of ours for libccd, which calls for supports in the world.
struct CcdShape {
  const ContactShape* shape;
  Mat3<double> turn;
  Vec3<double> middle;
};

void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* support) {
  const auto* placed = static_cast<const CcdShape*>(object);
  const Vec3<double> d(direction->v[0], direction->v[1], direction->v[2]);
  const ShapeCore& core = placed->shape->core();
  Vec3<double> p =
      placed->middle +
      placed->turn * support_of_core<CoreKind::other>(core, placed->turn.transpose() * d).point;
  if (core.radius > 0) p += (core.radius / d.norm()) * d;
  ccdVec3Set(support, p.x(), p.y(), p.z());
}

Contestant libccd_depth(const Asked& asked) {
  const auto places = [](const Everybody& body, auto pose_of, const Asked& of) {
    std::vector<CcdShape> all;
    for (const Placement& placed : of.where) {
      const PlacedCore core = minkray::placed(body.ready, placed.*pose_of);
      all.push_back({&body.ready, core.turn, core.middle});
    }
    return all;
  };
  return {"libccd, EPA", [a = places(asked.a, &Placement::a, asked),
                          b = places(asked.b, &Placement::b, asked)](std::size_t i) {
            ccd_t ccd;
            CCD_INIT(&ccd);
            ccd.support1 = ccd.support2 = ccd_support;
            ccd.max_iterations = 1000;
            ccd_real_t depth = 0;
            ccd_vec3_t direction, position;
            const bool overlaps =
                ccdGJKPenetration(&a[i], &b[i], &ccd, &depth, &direction, &position) == 0;
            return overlaps ? depth : no_answer;
          }};
}

Contestant fcl_depth(const Asked& asked, fcl::GJKSolverType solver, const char* name) {
  const auto poses = std::make_shared<Poses<fcl::Transform3d>>(asked, to_fcl);
  return {name, [poses, solver, a = asked.a.fcl, b = asked.b.fcl](std::size_t i) {
            fcl::CollisionRequestd request(1, true);
            request.gjk_solver_type = solver;
            fcl::CollisionResultd result;
            try {
              fcl::collide(a.get(), poses->a[i], b.get(), poses->b[i], request, result);
            } catch (const std::exception&) {
              return no_answer;
            }
            return result.isCollision() ? result.getContact(0).penetration_depth : no_answer;
          }};
}

Contestant bullet_depth(const Asked& asked) {
  const auto poses = std::make_shared<Poses<btTransform>>(asked, to_bullet);
  return {"Bullet, EPA (float)", [poses, a = asked.a.bullet, b = asked.b.bullet](std::size_t i) {
            btGjkEpaSolver2::sResults results;
            const btVector3 guess = poses->b[i].getOrigin() - poses->a[i].getOrigin();
            const bool overlaps = btGjkEpaSolver2::Penetration(a.get(), poses->a[i], b.get(),
                                                               poses->b[i], guess, results);
            return overlaps ? -double(results.distance) : no_answer;
          }};
}

}  // namespace

std::vector<Contestant> depths(const Asked& asked) {
  std::vector<Contestant> all = {
      {"Minkray", [&asked](std::size_t i) {
         const Placement& placed = asked.where[i];
         return -signed_distance(asked.a.ready, placed.a, asked.b.ready, placed.b).value;
       }}};
  all.push_back(libccd_depth(asked));
  if (asked.a.fcl && asked.b.fcl) {
    all.push_back(fcl_depth(asked, fcl::GST_INDEP, "FCL, own"));
    all.push_back(fcl_depth(asked, fcl::GST_LIBCCD, "FCL, libccd"));
  }
  if (asked.a.bullet && asked.b.bullet) all.push_back(bullet_depth(asked));
  for (std::vector<Contestant> others : {ode_contacts(asked), mujoco_contacts(asked, 0)})
    for (Contestant& one : others) {
      one.ask = [ask = one.ask](std::size_t i) { return -ask(i); };
      all.push_back(std::move(one));
    }
  return all;
}

}  // namespace minkray::bench
