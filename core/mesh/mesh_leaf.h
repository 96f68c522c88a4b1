// SPDX-License-Identifier: MIT
// Up to eight triangles of a mesh for eight float lanes. Corners are integers of 16 bits relative
// to the leaf's cube, so numbers in lanes are no larger than the leaf. The error of a corner is up
// to half a unit. Lanes therefore only select triangles, which are then tested in double.
#pragma once

#include <bit>
#include <cstdint>

namespace minkray {

/// A corner is at origin + number / scale, to within half a unit and the rounding of a double.
struct alignas(64) MeshLeaf {
  static constexpr int most = 8;  ///< maximum number of triangles

  std::uint16_t corners[3][3][most];  ///< by corner, axis, triangle
  float origin[3];                    ///< least corner of the leaf's cube, in the mesh's frame
  std::uint32_t packed_scale;         ///< the scale; its last three bits store size() - 1
  std::uint32_t triangles[most];      ///< numbers of the triangles in the mesh

  int size() const { return static_cast<int>(packed_scale & 7u) + 1; }
  /// Units per length.
  float scale() const { return std::bit_cast<float>(packed_scale); }
};
static_assert(sizeof(MeshLeaf) == 192);

}  // namespace minkray
