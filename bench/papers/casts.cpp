// SPDX-License-Identifier: MIT
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "bench/papers/comparisons.h"
#include "renderer/paper/distance.h"
#include "renderer/paper/shape_cast.h"
#include "renderer/paper/solvers.h"

namespace minkray::bench {
namespace {

Contestant our_cast(const Everywhere& a, const Everywhere& b, const Solver* solver,
                    const char* name) {
  return {name, [&a, &b, solver, A = a.ours, B = b.ours](const Query& query) {
            CastOptions options;
            options.solver = solver;
            const PreparedPair pair(centred(A, query.a), centred(B, query.b));
            const auto result = cast_shape(pair, query.motion, 1, options);
            return result.cast.found() ? double(result.cast.t()) : none;
          }};
}

}  // namespace

void compare_casts(const Everywhere& a, const Everywhere& b, const std::vector<Query>& all) {
  std::vector<Query> list;
  for (const Query& query : all)
    if (distance_between(centred(a.ours, query.a), centred(b.ours, query.b)).distance > 0.01)
      list.push_back(query);
  list.resize(queries, list.front());
  const auto bullet = [&](auto make) {
    return [&, make](const Query& query) {
      btVoronoiSimplexSolver simplex;
      auto cast = make(&simplex);
      btConvexCast::CastResult result;
      Affine<double> end = query.b;
      end.translation += query.motion;
      const btTransform A = to_bullet(query.a);
      const bool hit = cast.calcTimeOfImpact(A, A, to_bullet(query.b), to_bullet(end), result);
      return hit && result.m_fraction <= 1 ? double(result.m_fraction) : none;
    };
  };
  std::vector<Contestant> contestants = {
      our_cast(a, b, &solver::gjk_alone, "minkray, paper"),
      our_cast(a, b, &solver::automatic, "minkray, auto"),
      our_cast(a, b, &solver::first_solution, "minkray, Algorithm 1"),
      {"Bullet btSubsimplexConvexCast", bullet([&](btVoronoiSimplexSolver* simplex) {
         return btSubsimplexConvexCast(a.bullet.get(), b.bullet.get(), simplex);
       })},
      {"Bullet btGjkConvexCast", bullet([&](btVoronoiSimplexSolver* simplex) {
         return btGjkConvexCast(a.bullet.get(), b.bullet.get(), simplex);
       })}};
  if (a.fcl && b.fcl)
    contestants.push_back({"FCL conservative advancement", [&](const Query& query) {
                             fcl::ContinuousCollisionRequestd request;
                             request.ccd_motion_type = fcl::CCDM_TRANS;
                             request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
                             request.gjk_solver_type = fcl::GST_INDEP;
                             fcl::ContinuousCollisionResultd result;
                             fcl::Transform3d end = to_fcl(query.b);
                             end.translation() += query.motion;
                             try {
                               fcl::continuousCollide(a.fcl.get(), to_fcl(query.a), to_fcl(query.a),
                                                      b.fcl.get(), to_fcl(query.b), end, request,
                                                      result);
                             } catch (const std::exception&) {
                               return none;
                             }
                             return result.is_collide ? result.time_of_contact : none;
                           }});
  race(contestants, list);
  print(std::string("shape cast of ") + b.name + " at " + a.name + ", t in [0, 1]", contestants);
}

}  // namespace minkray::bench
