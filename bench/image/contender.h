// SPDX-License-Identifier: MIT
// The list of all tracers, each with its name and how to make it.
#pragma once

#include <functional>

#include "bench/image/tracers.h"

namespace minkray::bench {

struct Contender {
  std::string name;
  std::function<std::unique_ptr<Tracer>(const Scene&, int threads)> make;
  double mesh_error = 0;  ///< of triangles: of a shape's bounding radius
};

/// Minkray in float, which all others are compared with.
inline constexpr std::string_view ours = "minkray";

/// Options for the contenders.
struct ContenderWishes {
  std::vector<double> mesh_errors = {1e-4, 1e-6};
  bool user_geometry = true;
  bool our_cast_in_user_geometry = true;
  bool round_geometry = false;   ///< Embree's own spheres and capsules
  bool fast_build = false;       ///< ours also with a hierarchy that is built fast
  bool default_quality = false;  ///< meshes also at Embree's default quality
};

/// The first is `ours`; only those that can take the scene. Makes the meshes.
std::vector<Contender> contenders_for(const Scene& scene, const ContenderWishes& wishes);

}  // namespace minkray::bench
