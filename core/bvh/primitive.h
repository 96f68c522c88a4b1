// SPDX-License-Identifier: MIT
// Primitives for the BVH builders: boxes in SIMD registers, with their index.
#pragma once

#include <bit>
#include <cstdint>

#include "core/math/bounds.h"
#include "core/math/wide.h"

namespace minkray {

/// Three coordinates; the fourth lane is ignored.
using Float4 = Wide<float, 4, IsaHere>;

struct BuildBox {
  Float4 lower = Float4(std::numeric_limits<float>::infinity());
  Float4 upper = Float4(-std::numeric_limits<float>::infinity());

  void extend(const BuildBox& other) {
    lower = min(lower, other.lower);
    upper = max(upper, other.upper);
  }
  void extend(const Float4& point) {
    lower = min(lower, point);
    upper = max(upper, point);
  }

  /// Half of the surface area, in double so that float extents cannot overflow it.
  double area() const {
    const auto extent = [&](int i) { return double(upper.lane(i)) - double(lower.lane(i)); };
    const double x = extent(0), y = extent(1), z = extent(2);
    return x * y + y * z + z * x;
  }

  Bounds<float> bounds() const {
    return {{lower.lane(0), lower.lane(1), lower.lane(2)},
            {upper.lane(0), upper.lane(1), upper.lane(2)}};
  }
};

struct Primitive {
  BuildBox box;  ///< the index is kept in the fourth lane of `lower`

  Primitive() = default;
  Primitive(const Bounds<float>& bounds, std::uint32_t index) {
    for (int i = 0; i < 3; ++i) {
      box.lower.set_lane(i, bounds.lower[i]);
      box.upper.set_lane(i, bounds.upper[i]);
    }
    box.lower.set_lane(3, std::bit_cast<float>(index));
    box.upper.set_lane(3, 0);
  }

  std::uint32_t index() const { return std::bit_cast<std::uint32_t>(box.lower.lane(3)); }

  /// Twice the centre; 0, not NaN, for unbounded boxes. The fourth lane is 0, since products with
  /// the index, which is a subnormal number, would be slow.
  Float4 middle() const {
    constexpr float most = std::numeric_limits<float>::max();
    Float4 limits(most);
    limits.set_lane(3, -1);
    const Float4 sum = box.lower + box.upper;
    return select(abs(sum) <= limits, sum, Float4(0.0f));
  }
};
static_assert(sizeof(Primitive) == 32);

/// Two boxes for a range of primitives: one around the primitives, one around their doubled
/// centres.
struct Extent {
  BuildBox box;
  BuildBox middles;

  void add(const Primitive& primitive) {
    box.extend(primitive.box);
    middles.extend(primitive.middle());
  }
  void extend(const Extent& other) {
    box.extend(other.box);
    middles.extend(other.middles);
  }
};

}  // namespace minkray
