// SPDX-License-Identifier: MIT
#include "bench/image/contender.h"

#include <iostream>
#include <sstream>

#include "core/parallel/parallel.h"

namespace minkray::bench {

std::vector<Contender> contenders_for(const Scene& scene, const ContenderWishes& wishes) {
  std::vector<Contender> all;
  all.push_back({std::string(ours), [](const Scene& s, int) { return exact_shapes(s); }, 0});
  if (wishes.fast_build)
    all.push_back({"minkray, fast build",
                   [](const Scene& s, int) { return exact_shapes(s, BvhBuild::speed); }, 0});
  for (const double error : wishes.mesh_errors) {
    const auto meshes = std::make_shared<const Meshes>(meshes_of(scene, error));
    std::ostringstream name;
    name << "embree triangles " << error;
    std::cerr << name.str() << ": " << meshes->meshes.size() << " meshes, " << meshes->triangles()
              << " triangles, made in " << meshes->seconds << " s\n";
    const auto add = [&](const std::string& label, bool highest_quality) {
      all.push_back({label,
                     [meshes, highest_quality](const Scene& s, int threads) {
                       return embree_triangles(s, *meshes, highest_quality, threads);
                     },
                     error});
    };
    add(name.str(), true);
    if (wishes.default_quality) add(name.str() + " medium", false);
  }
  if (wishes.user_geometry) {
    if (wishes.our_cast_in_user_geometry)
      all.push_back({"embree user, our cast", embree_with_our_cast, 0});
    if (has_closed_form(scene))
      all.push_back({"embree user, closed form", embree_with_closed_form, 0});
  }
  if (wishes.round_geometry && has_round_geometry(scene))
    all.push_back({"embree round geometry", embree_round, 0});
  return all;
}

}  // namespace minkray::bench
