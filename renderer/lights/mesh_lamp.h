// SPDX-License-Identifier: MIT
// Samples emissive meshes: a triangle by its brightness over squared distance, then a point of it.
// A sample counts if that triangle is the first that its ray meets.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/world/posed_mesh.h"
#include "renderer/lights/light_tree.h"

namespace minkray {

class MeshLamp {
 public:
  /// Takes the brightness of each triangle, at least 0. Refers to the mesh.
  MeshLamp(const PosedMesh& mesh, const std::function<double(std::uint32_t)>& brightness);

  struct Sample {
    Vec3<double> direction;  ///< of unit length
    double distance;
    std::uint32_t part;
  };
  /// Needs three numbers in [0, 1). Points are in the world.
  std::optional<Sample> sample(const Vec3<double>& point, double which,
                               const std::array<double, 2>& u) const;
  /// Density over solid angle with which `sample` draws a direction whose first hit is at distance
  /// t on the part. Zero edge-on, and from outside of a closed mesh if the part faces away.
  double pdf(const Vec3<double>& point, const Vec3<double>& direction, std::uint32_t part,
             double t) const;

  bool none() const { return tree_.empty(); }
  const Vec3<double>& centre() const { return centre_; }
  double radius() const { return radius_; }
  /// Brightness times a quarter of the area, which is a closed convex surface's shadow on average,
  /// over pi.
  double power() const { return power_; }
  double size2() const { return size2_; }

 private:
  static constexpr std::uint32_t no_light = ~std::uint32_t{0};

  Vec3<double> corner(std::uint32_t part, std::size_t k) const {
    return pose_(mesh_->corner(part, k));
  }
  /// Twice the area, along the normal.
  Vec3<double> across(std::uint32_t part) const;

  std::shared_ptr<const TriangleMesh> mesh_;
  Affine<double> pose_;
  Bounds<double> bounds_;
  bool hides_backs_;  ///< from points outside of the bounds
  double outwards_;   ///< sign of a normal that faces out, in the world
  LightTree tree_;
  std::vector<std::uint32_t> triangles_;  ///< those that shine, in the tree's order
  std::vector<std::uint32_t> light_of_;   ///< the way back
  Vec3<double> centre_ = Vec3<double>::Zero();
  double radius_ = 0, power_ = 0, size2_ = 0;
};

}  // namespace minkray
