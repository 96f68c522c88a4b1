// SPDX-License-Identifier: MIT
// FCL: distances by either of its solvers, casts by conservative advancement. No rays.
#include <fcl/fcl.h>

#include "bench/league/adapter.h"

namespace {

using namespace league;

fcl::Transform3d placed(const Solid& solid) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result.linear()(i, j) = solid.turn[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  result.translation() = fcl::Vector3d(solid.at[0], solid.at[1], solid.at[2]);
  return result;
}

std::shared_ptr<fcl::CollisionGeometryd> shape_of(const Solid& solid) {
  const double radius = solid.sizes[0], height = 2 * solid.sizes[1];
  switch (solid.kind) {
    case Kind::sphere:
      return std::make_shared<fcl::Sphered>(radius);
    case Kind::capsule:
      return std::make_shared<fcl::Capsuled>(radius, height);
    case Kind::box:
      return std::make_shared<fcl::Boxd>(2 * solid.sizes[0], 2 * solid.sizes[1],
                                         2 * solid.sizes[2]);
    case Kind::cylinder:
      return std::make_shared<fcl::Cylinderd>(radius, height);
    case Kind::cone:
      return std::make_shared<fcl::Coned>(radius, height);
    case Kind::ellipsoid:
      return std::make_shared<fcl::Ellipsoidd>(solid.sizes[0], solid.sizes[1], solid.sizes[2]);
    case Kind::hull: {
      const auto triangles = hull_triangles(solid.points);
      if (triangles.empty()) return nullptr;
      auto points = std::make_shared<std::vector<fcl::Vector3d>>();
      for (const Vec& p : solid.points) points->emplace_back(p[0], p[1], p[2]);
      auto faces = std::make_shared<std::vector<int>>();
      for (const auto& t : triangles) faces->insert(faces->end(), {3, t[0], t[1], t[2]});
      return std::make_shared<fcl::Convexd>(points, static_cast<int>(triangles.size()), faces);
    }
    default:
      return nullptr;
  }
}

Ask prepare(const Query& query, fcl::GJKSolverType solver) {
  if (query.asked == Asked::ray) return [] { return unsupported("FCL has no rays"); };
  const auto a = shape_of(query.a), b = shape_of(query.b);
  if (!a || !b) return [] { return unsupported("FCL has no such shape"); };
  const fcl::Transform3d at_a = placed(query.a), at_b = placed(query.b);
  if (query.asked == Asked::shape) {
    fcl::Transform3d end = at_b;
    for (int k = 0; k < 3; ++k)
      end.translation()[k] += query.t_max * query.direction[static_cast<std::size_t>(k)];
    return [=, t_max = query.t_max] {
      fcl::ContinuousCollisionRequestd request;
      request.num_max_iterations = 1000;
      request.toc_err = 1e-9;
      request.ccd_motion_type = fcl::CCDM_TRANS;
      request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
      request.gjk_solver_type = solver;
      fcl::ContinuousCollisionResultd result;
      fcl::continuousCollide(a.get(), at_a, at_a, b.get(), at_b, end, request, result);
      return result.is_collide ? hit(result.time_of_contact * t_max) : miss();
    };
  }
  // FCL's own solver has no depths: a request for them ends at an assertion.
  const bool is_signed = query.asked == Asked::signed_distance;
  const bool has_depths = solver == fcl::GJKSolverType::GST_LIBCCD;
  return [=] {
    fcl::DistanceRequestd request;
    request.gjk_solver_type = solver;
    request.enable_signed_distance = is_signed && has_depths;
    request.enable_nearest_points = true;
    request.distance_tolerance = 1e-9;
    fcl::DistanceResultd result;
    fcl::distance(a.get(), at_a, b.get(), at_b, request, result);
    if (is_signed && !has_depths && result.min_distance <= 0)
      return Answer{Answer::Status::overlapping};
    return at_distance(is_signed ? result.min_distance : std::max(0.0, result.min_distance));
  };
}

}  // namespace

int main(int argc, char** argv) {
  const std::string all =
      "double; distance_tolerance 1e-9; casts: conservative advancement, toc_err 1e-9, 1000 "
      "iterations; ";
  return serve(argc, argv,
               {{"fcl-libccd", FCL_VERSION, all + "GST_LIBCCD (the default)",
                 [](const Query& q) { return prepare(q, fcl::GJKSolverType::GST_LIBCCD); }},
                {"fcl-indep", FCL_VERSION, all + "GST_INDEP, without depths",
                 [](const Query& q) { return prepare(q, fcl::GJKSolverType::GST_INDEP); }}});
}
