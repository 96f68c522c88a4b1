// SPDX-License-Identifier: MIT
// Texture coordinates: maps points of surfaces, and their footprints, to repeats of a texture, in
// space or in the plane of a mapping.
#pragma once

#include <array>

#include "renderer/rays/ray_cone.h"
#include "renderer/scene/textures.h"

namespace minkray {

/// A place on a surface, in the object's frame.
struct TexturePoint {
  Vec3<double> position = Vec3<double>::Zero();
  Vec3<double> normal = Vec3<double>::UnitZ();  ///< outward, of unit length
  /// Footprint that the colour is averaged over; zero: the point itself.
  SurfaceFootprint footprint = {Vec3<double>::Zero(), Vec3<double>::Zero()};
  /// Texture coordinates of a mesh, and how they change along x, y and z; zero if it has none.
  bool has_uv = false;
  Vec3<double> uv = Vec3<double>::Zero();
  std::array<Vec3<double>, 2> uv_slopes = {Vec3<double>::Zero(), Vec3<double>::Zero()};

  /// Returns the change of the coordinates along a side.
  Vec3<double> uv_change(const Vec3<double>& side) const {
    return {uv_slopes[0].dot(side), uv_slopes[1].dot(side), 0};
  }
  /// Returns a place next to this one, on the plane that touches the surface.
  TexturePoint moved(const Vec3<double>& by) const {
    TexturePoint other = *this;
    other.position += by;
    other.uv += uv_change(by);
    return other;
  }
};

/// A place in repeats, and a parallelogram around it by its sides.
struct TexturePlace {
  Vec3<double> middle;
  std::array<Vec3<double>, 2> sides;

  /// In other units.
  TexturePlace times(const Vec3<double>& size) const {
    return {middle.cwiseProduct(size), {sides[0].cwiseProduct(size), sides[1].cwiseProduct(size)}};
  }
};

/// Without a mapping, in space.
TexturePlace texture_place(const TexturePoint& at, const Mapping& mapping, double scale);

/// Longitude around z as a part of a turn, 0 and 1 being at -x and 0.5 at +x, and latitude from the
/// top down as a part of half a turn; the third number is 0.
Vec3<double> radial_place(const Vec3<double>& direction);

/// Direction that is right in pictures of a mapping, seen from outside; not along the surface.
Vec3<double> picture_right(const TexturePoint& at, const Mapping& mapping);

}  // namespace minkray
