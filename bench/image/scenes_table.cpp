// SPDX-License-Identifier: MIT
#include "bench/image/scenes_table.h"

#include <algorithm>
#include <iostream>

namespace minkray::bench {
namespace {

/// Goal for one kind of rays: a factor of speed over the others.
struct Asked {
  RayKindAsked rays;
  std::string_view other;  ///< beginning of the contender's name
  double at_least;
};

constexpr std::string_view triangles = "embree triangles", closed_form = "embree user, closed form",
                           round_geometry = "embree round geometry";

struct Row {
  std::string kind;
  std::size_t objects;
  std::vector<Asked> asked;
};

/// The table. Exact triangles of hulls are the same at any error.
std::vector<Row> rows() {
  using enum RayKindAsked;
  return {
      {"rounded-boxes",
       100000,
       {{scattered, triangles, 2.2},
        {scattered, closed_form, 2.0},
        {camera, triangles, 2.8},
        {camera, closed_form, 2.0},
        {scattered_shadows, triangles, 2.0},
        {scattered_shadows, closed_form, 2.0},
        {light_shadows, triangles, 1.3},
        {light_shadows, closed_form, 1.3}}},
      {"rounded-boxes", 10000, {{scattered, triangles, 1.6}, {scattered, closed_form, 1.6}}},
      {"rounded-boxes", 1000000, {{scattered, triangles, 3}, {scattered, closed_form, 3}}},
      {"spheres", 100000, {{scattered, round_geometry, 1.5}, {camera, round_geometry, 1.5}}},
      {"capsules", 100000, {{scattered, round_geometry, 1.5}, {camera, round_geometry, 1.5}}},
      {"ellipsoids", 100000, {{scattered, triangles, 1.8}, {camera, triangles, 1.8}}},
      {"hulls-16", 100000, {{scattered, triangles, 1.5}, {camera, triangles, 1.5}}},
      {"hulls-64", 100000, {{scattered, triangles, 1.0}, {camera, triangles, 1.0}}},
      {"mixed", 100000, {{scattered, triangles, 1.8}, {camera, triangles, 1.8}}},
  };
}

std::string objects_text(std::size_t count) {
  return count % 1000000 == 0 ? std::to_string(count / 1000000) + "M"
                              : std::to_string(count / 1000) + "k";
}

}  // namespace

Json measure_scenes(const ImageBenchOptions& options, std::vector<Goal>& goals) {
  Json list = Json::array();
  for (const Row& row : rows()) {
    const Subject subject = make_subject(row.kind, row.objects);
    ContenderWishes wishes;
    wishes.mesh_errors = {1e-4};
    wishes.our_cast_in_user_geometry = false;
    wishes.round_geometry = true;
    const std::string name = objects_text(row.objects) + " " + row.kind;
    std::cout << "\n" << name << "\n";
    Json results = Json::array();
    for (const CastResults& one : measure_casts(subject, contenders_for(subject.scene, wishes),
                                                options.rays, options.rounds, true)) {
      print(std::cout, one);
      results.push_back(as_json(one));
      for (const Asked& asked : row.asked) {
        if (asked.rays != one.kind) continue;
        const std::string bound = std::to_string(asked.at_least).substr(0, 3);
        goals.push_back({name + ", " + one.rays + ": " + std::string(asked.other), ">= " + bound,
                         asked.at_least, false, one.best_ratio(asked.other)});
      }
    }
    const std::size_t bytes = exact_shapes(subject.scene)->bytes();
    const double each = static_cast<double>(bytes) / static_cast<double>(row.objects);
    goals.push_back({name + ": bytes an object, shapes shared", "<= 90", 90, true, each});
    list.push_back({{"scene", name}, {"bytes_an_object", each}, {"casts", std::move(results)}});
  }
  return list;
}

}  // namespace minkray::bench
