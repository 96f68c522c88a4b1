// SPDX-License-Identifier: MIT
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#include <ccd/ccd.h>

#include <array>

#include "bench/papers/comparisons.h"
#include "renderer/paper/distance.h"

namespace minkray::bench {
namespace {

Contestant our_distance(const Everywhere& a, const Everywhere& b, SubalgorithmKind kind,
                        const char* name) {
  const CentredShape A = centred(a.ours), B = centred(b.ours);
  return {
      name, [=](const Query& query) {
        const auto place = [](const CentredShape& shape, const Affine<double>& pose) {
          const Affine<double> at = pose;
          return CentredShape{Transform{Nested(shape.about_centre),
                                        Affine<double>{at.linear, Vec3<double>::Zero()}},
                              at(shape.centre), shape.radius};
        };
        return double(distance_between(place(A, query.a), place(B, query.b), {}, kind).distance);
      }};
}

/// A shape of ours for libccd, which calls for supports in the world.
struct CcdShape {
  const Shape* shape;
  Affine<double> pose;
};

void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* support) {
  const auto* placed = static_cast<const CcdShape*>(object);
  const Vec3<double> d(direction->v[0], direction->v[1], direction->v[2]);
  const Vec3<double> p =
      placed->pose(placed->shape->support<double>(placed->pose.linear.transpose() * d));
  ccdVec3Set(support, p.x(), p.y(), p.z());
}

}  // namespace

void compare_distances(const Everywhere& a, const Everywhere& b, const std::vector<Query>& list) {
  std::vector<Contestant> contestants = {
      our_distance(a, b, SubalgorithmKind::projection, "minkray, projection"),
      our_distance(a, b, SubalgorithmKind::johnson, "minkray, johnson"),
      our_distance(a, b, SubalgorithmKind::signed_volumes, "minkray, signed volumes"),
  };
  contestants.push_back(
      {"Bullet btGjkPairDetector (float)", [&](const Query& query) {
         btVoronoiSimplexSolver simplex;
         btGjkPairDetector detector(a.bullet.get(), b.bullet.get(), &simplex, nullptr);
         btGjkPairDetector::ClosestPointInput input;
         input.m_transformA = to_bullet(query.a);
         input.m_transformB = to_bullet(query.b);
         btPointCollector output;
         detector.getClosestPoints(input, output, nullptr);
         return output.m_hasResult ? std::max(0.0, double(output.m_distance)) : 0.0;
       }});
  if (a.fcl && b.fcl)
    for (const auto solver : {fcl::GJKSolverType::GST_INDEP, fcl::GJKSolverType::GST_LIBCCD})
      contestants.push_back({solver == fcl::GJKSolverType::GST_INDEP ? "FCL distance, own GJK"
                                                                     : "FCL distance, libccd",
                             [&, solver](const Query& query) {
                               fcl::DistanceRequestd request;
                               request.gjk_solver_type = solver;
                               request.enable_signed_distance = false;
                               fcl::DistanceResultd result;
                               try {
                                 fcl::distance(a.fcl.get(), to_fcl(query.a), b.fcl.get(),
                                               to_fcl(query.b), request, result);
                               } catch (const std::exception&) {
                                 return none;
                               }
                               return std::max(0.0, result.min_distance);
                             }});
  race(contestants, list);
  print(std::string("distance ") + a.name + " to " + b.name, contestants);
}

void compare_overlaps(const Everywhere& a, const Everywhere& b, const std::vector<Query>& list) {
  const Contestant ours = our_distance(a, b, SubalgorithmKind::projection, "minkray");
  std::vector<Contestant> contestants = {
      {"minkray, distance", [&](const Query& query) { return ours.ask(query) > 0 ? none : 0.0; }},
      {"libccd ccdGJKIntersect, our supports", [&](const Query& query) {
         ccd_t ccd;
         CCD_INIT(&ccd);
         ccd.support1 = ccd.support2 = ccd_support;
         ccd.max_iterations = 1000;
         const CcdShape A{&a.ours, query.a}, B{&b.ours, query.b};
         return ccdGJKIntersect(&A, &B, &ccd) ? 0.0 : none;
       }}};
  race(contestants, list);
  print(std::string("overlap of ") + a.name + " and " + b.name, contestants);
}

}  // namespace minkray::bench
