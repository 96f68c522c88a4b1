// SPDX-License-Identifier: MIT
// State of a path: its current ray, its last vertex on a surface, and the light sampled there.
#pragma once

#include <vector>

#include "renderer/paths/inside.h"
#include "renderer/paths/path_transport.h"

namespace minkray {

/// A path, and the ray that continues from its end.
struct PathTransport::Path {
  Ray<double> ray;
  Sampler sampler;
  double time = 0;
  std::uint32_t left = no_instance;
  Inside inside;
  RayCone cone;  ///< of the ray

  Colour throughput = Colour::Ones();
  Colour radiance = Colour::Zero();
  Colour direct = Colour::Zero();  ///< of the radiance: what was scattered at most once
  int depth = 0, passages = 0;
  bool is_sharp = true;           ///< the ray's direction had no density
  bool is_straight = true;        ///< nothing was passed since the last scattering
  bool only_sharp = true;         ///< all directions so far had none
  double pdf = 0;                 ///< of the ray's direction
  Vec3<double> from = {0, 0, 0};  ///< place of the last scattering
  double gathered = 1;            ///< eta^2 of where the path is: dense media gather radiance
  bool goes_on = true;
};

/// A point where a path met a surface that scatters light.
struct PathTransport::Point {
  Vec3<double> position;
  double rounding;
  Vec3<double> normal;   ///< outward; the frame's may be bent by a relief
  Vec3<double> lift;     ///< to where scattered light arrives: on a mesh with normals
  Vec3<double> horizon;  ///< scattered light comes from this side: the normal, or the mesh's own
  Frame frame;
  Shading shading;
  const Bsdf* bsdf;
  std::uint32_t instance;
  Inside above, below;  ///< bodies that contain the places just above and below the surface
  TexturePoint place;   ///< place that `shading` refers to
  bool is_bent;         ///< the frame, from the normal

  /// Place for which light is sampled.
  Vec3<double> lit_at() const { return position + lift; }
  /// A ray that goes from here; what holds it is `inside(w)`. Mirrored rays leave the triangle
  /// itself.
  Ray<double> ray(const Vec3<double>& w, const Vec3<double>& direction,
                  bool is_sharp = false) const {
    if (!(w.z() > 0)) return {position, direction};
    const Vec3<double> clear = position + rounding * normal;
    return {is_sharp ? clear : Vec3<double>(clear + lift), direction};
  }
  /// True if the direction is on the same side of the surface and of its relief.
  bool is_on_side(const Vec3<double>& w, const Vec3<double>& direction,
                  bool is_sharp = false) const {
    if (!is_bent) return true;
    const bool is_above = w.z() > 0;
    return is_above == (direction.dot(is_above && !is_sharp ? horizon : normal) > 0);
  }
  const Inside& inside(const Vec3<double>& w) const { return w.z() > 0 ? above : below; }
};

/// Light that arrives at a path's end, if unoccluded.
struct PathTransport::Arriving {
  std::size_t path;
  Colour light;
  std::uint32_t emitter = no_instance;  ///< that must be met
  std::uint32_t part = no_part;         ///< of a mesh, as well

  bool is_from(std::uint32_t instance, std::uint32_t triangle) const {
    return instance == emitter && (part == no_part || triangle == part);
  }
};

/// Shadow rays, traced together. In whatever order they are traced, a path's sum is the same: each
/// path has one ray in each of these.
struct PathTransport::ShadowRays {
  std::vector<WorldRay> rays;
  std::vector<Arriving> arriving;

  void clear() {
    rays.clear();
    arriving.clear();
  }
  void add(const WorldRay& ray, const Arriving& light) {
    rays.push_back(ray);
    arriving.push_back(light);
  }
};

}  // namespace minkray
