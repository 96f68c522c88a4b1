// SPDX-License-Identifier: MIT
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "bench/contact/peers.h"
#include "core/pair_motion/impact.h"
#include "renderer/paper/shape_cast.h"

namespace minkray::bench {
namespace {

template <class Make>
Contestant bullet_cast(const Asked& asked, const char* name, const Make& make) {
  const auto poses = std::make_shared<Poses<btTransform>>(asked, to_bullet);
  return {name, [=, a = asked.a.bullet_for_casts, b = asked.b.bullet_for_casts](std::size_t i) {
            btVoronoiSimplexSolver simplex;
            auto cast = make(a.get(), b.get(), &simplex);
            btConvexCast::CastResult result;
            const bool hit =
                cast.calcTimeOfImpact(poses->a[i], poses->a[i], poses->b[i], poses->end[i], result);
            return hit && result.m_fraction <= 1 ? double(result.m_fraction) : no_answer;
          }};
}

Contestant fcl_cast(const Asked& asked) {
  const auto poses = std::make_shared<Poses<fcl::Transform3d>>(asked, to_fcl);
  return {"FCL, conservative advancement",
          [poses, a = asked.a.fcl, b = asked.b.fcl](std::size_t i) {
            fcl::ContinuousCollisionRequestd request;
            request.ccd_motion_type = fcl::CCDM_TRANS;
            request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
            request.gjk_solver_type = fcl::GST_INDEP;
            fcl::ContinuousCollisionResultd result;
            try {
              fcl::continuousCollide(a.get(), poses->a[i], poses->a[i], b.get(), poses->b[i],
                                     poses->end[i], request, result);
            } catch (const std::exception&) {
              return no_answer;
            }
            return result.is_collide ? result.time_of_contact : no_answer;
          }};
}

/// The older function: the pair is prepared for the poses.
Contestant older_cast(const Asked& asked) {
  return {"older", [&asked](std::size_t i) {
            const Placement& placed = asked.where[i];
            const PreparedPair pair(centred(asked.a.ours, placed.a),
                                    centred(asked.b.ours, placed.b));
            const auto result = cast_shape(pair, placed.motion, 1.0);
            return result.cast.found() ? result.cast.t() : no_answer;
          }};
}

}  // namespace

std::vector<Contestant> impacts(const Asked& asked) {
  std::vector<Contestant> all = {
      {"Minkray",
       [&asked](std::size_t i) {
         const Placement& placed = asked.where[i];
         ImpactOptions options;
         options.points_of_misses = false;  // none of the others returns them
         const Impact found = first_impact(asked.a.ready, {placed.a}, asked.b.ready,
                                           {placed.b, placed.motion}, 1, options);
         return found.status == ImpactStatus::hit ? found.t_lo : no_answer;
       }},
      older_cast(asked)};
  if (asked.a.bullet_for_casts && asked.b.bullet_for_casts) {
    using Shape = const btConvexShape*;
    all.push_back(bullet_cast(asked, "Bullet, subsimplex (float)",
                              [](Shape a, Shape b, btSimplexSolverInterface* simplex) {
                                return btSubsimplexConvexCast(a, b, simplex);
                              }));
    all.push_back(bullet_cast(asked, "Bullet, GJK (float)",
                              [](Shape a, Shape b, btSimplexSolverInterface* simplex) {
                                return btGjkConvexCast(a, b, simplex);
                              }));
    const auto depth = std::make_shared<btGjkEpaPenetrationDepthSolver>();
    all.push_back(bullet_cast(asked, "Bullet, continuous (float)",
                              [depth](Shape a, Shape b, btSimplexSolverInterface* simplex) {
                                return btContinuousConvexCollision(a, b, simplex, depth.get());
                              }));
  }
  // FCL refuses to cast ellipsoids and hulls.
  const auto fcl_casts = [](const Everybody& body) {
    return body.fcl && !body.is_hull() && body.name != "ellipsoid";
  };
  if (fcl_casts(asked.a) && fcl_casts(asked.b)) all.push_back(fcl_cast(asked));
  return all;
}

}  // namespace minkray::bench
