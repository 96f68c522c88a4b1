// SPDX-License-Identifier: MIT
#include "renderer/paper/distance.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <algorithm>

#include "bench/contact/peers.h"
#include "core/pair_distance/signed_distance.h"

namespace minkray::bench {
namespace {

Contestant bullet_distance(const Asked& asked) {
  const auto poses = std::make_shared<Poses<btTransform>>(asked, to_bullet);
  return {"Bullet, GJK (float)", [poses, a = asked.a.bullet, b = asked.b.bullet](std::size_t i) {
            btVoronoiSimplexSolver simplex;
            btGjkPairDetector detector(a.get(), b.get(), &simplex, nullptr);
            btGjkPairDetector::ClosestPointInput input;
            input.m_transformA = poses->a[i];
            input.m_transformB = poses->b[i];
            btPointCollector output;
            detector.getClosestPoints(input, output, nullptr);
            return output.m_hasResult ? std::max(0.0, double(output.m_distance)) : 0.0;
          }};
}

Contestant fcl_distance(const Asked& asked, fcl::GJKSolverType solver, const char* name) {
  const auto poses = std::make_shared<Poses<fcl::Transform3d>>(asked, to_fcl);
  return {name, [poses, solver, a = asked.a.fcl, b = asked.b.fcl](std::size_t i) {
            fcl::DistanceRequestd request;
            request.gjk_solver_type = solver;
            request.enable_signed_distance = false;
            fcl::DistanceResultd result;
            try {
              fcl::distance(a.get(), poses->a[i], b.get(), poses->b[i], request, result);
            } catch (const std::exception&) {
              return no_answer;
            }
            return std::max(0.0, result.min_distance);
          }};
}

/// The function from before signed distances: its shapes are made for the poses.
Contestant older_distance(const Asked& asked) {
  return {"older", [&asked, a = centred(asked.a.ours), b = centred(asked.b.ours)](std::size_t i) {
            const auto place = [](const CentredShape& shape, const Affine<double>& pose) {
              const Affine<double> turn{pose.linear, Vec3<double>::Zero()};
              return CentredShape{Transform{Nested(shape.about_centre), turn}, pose(shape.centre),
                                  shape.radius};
            };
            const Placement& placed = asked.where[i];
            return distance_between(place(a, placed.a), place(b, placed.b), {},
                                    SubalgorithmKind::signed_volumes)
                .distance;
          }};
}

}  // namespace

std::vector<Contestant> distances(const Asked& asked) {
  std::vector<Contestant> all = {{"Minkray",
                                  [&asked](std::size_t i) {
                                    SignedDistanceOptions options;
                                    options.only_sign = true;
                                    const Placement& placed = asked.where[i];
                                    const SignedDistance found = signed_distance(
                                        asked.a.ready, placed.a, asked.b.ready, placed.b, options);
                                    return std::max(0.0, found.value);
                                  }},
                                 older_distance(asked)};
  if (asked.a.bullet && asked.b.bullet) all.push_back(bullet_distance(asked));
  if (asked.a.fcl && asked.b.fcl) {
    all.push_back(fcl_distance(asked, fcl::GST_INDEP, "FCL, own GJK"));
    all.push_back(fcl_distance(asked, fcl::GST_LIBCCD, "FCL, libccd"));
  }
  for (Contestant& one : mujoco_contacts(asked, 10)) {
    one.ask = [ask = one.ask](std::size_t i) { return std::max(0.0, ask(i)); };
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace minkray::bench
