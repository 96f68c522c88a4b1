// SPDX-License-Identifier: MIT
// One shape with many poses, stored as the numbers per particle that its file holds.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/affine.h"
#include "core/shape/shape.h"
#include "renderer/scene/visible_to.h"

namespace minkray {

/// Meaning of the numbers of a particle's row.
enum class ParticleColumn : unsigned char { position, rotation, scale, scales, material };

struct ParticleColumnDescription {
  ParticleColumn column;
  std::string_view name;
  std::size_t numbers;
  std::string_view doc;
};

inline constexpr ParticleColumnDescription particle_columns[] = {
    {ParticleColumn::position, "position", 3, "the position of the shape's origin: x y z"},
    {ParticleColumn::rotation, "rotation", 4, "a quaternion x y z w of any length but zero"},
    {ParticleColumn::scale, "scale", 1, "a factor for all three axes of the shape, applied first"},
    {ParticleColumn::scales, "scales", 3, "a factor for each axis of the shape, applied first"},
    {ParticleColumn::material, "material", 1, "an index into the block's \"materials\", from 0"},
};

/// Particles of one shape. Rows of poses lie one behind the other: position, then rotation, then
/// scale or scales, those of them that there are.
struct ParticleSet {
  std::string name;
  Shape shape = Point{};
  std::vector<std::uint32_t> materials;  ///< indices into Scene::materials, at least one
  bool has_rotation = false;
  std::size_t scale_numbers = 0;  ///< 0, 1 or 3
  std::vector<double> poses;
  std::vector<std::uint16_t> material_of;  ///< by particle, into `materials`; empty: the first
  RayKinds visible_to = all_ray_kinds;     ///< as an object's

  std::size_t row_numbers() const { return 3 + (has_rotation ? 4 : 0) + scale_numbers; }
  std::size_t size() const { return poses.size() / row_numbers(); }

  /// True if the poses differ in translation only.
  bool linear_alike() const { return !has_rotation && scale_numbers == 0; }

  Affine<double> pose(std::size_t i) const {
    const double* at = poses.data() + i * row_numbers();
    const Vec3<double> translate(at[0], at[1], at[2]);
    if (linear_alike()) return {Mat3<double>::Identity(), translate};
    at += 3;
    Mat3<double> rotate = Mat3<double>::Identity();
    if (has_rotation) {
      rotate = rotation_matrix_of_any(at[0], at[1], at[2], at[3]);
      at += 4;
    }
    Vec3<double> scale = Vec3<double>::Ones();
    if (scale_numbers == 1) scale = Vec3<double>::Constant(at[0]);
    if (scale_numbers == 3) scale = {at[0], at[1], at[2]};
    return from_translate_rotate_scale<double>(translate, rotate, scale);
  }

  std::uint32_t material(std::size_t i) const {
    return materials[material_of.empty() ? 0 : material_of[i]];
  }

  std::size_t bytes() const {
    return poses.capacity() * sizeof(double) + material_of.capacity() * sizeof(std::uint16_t);
  }
};

}  // namespace minkray
