// SPDX-License-Identifier: MIT
// Small unevenness of a surface, which is seen in how it is lit but has no shape of its own.
#pragma once

#include "core/support/field.h"
#include "renderer/scene/textures.h"

namespace minkray {

/// Keys that every material may have.
struct Relief {
  PaintIfAny bump;
  double bump_height = 0.01;
  PaintIfAny normal_map;

  bool any() const { return bump.has_value() || normal_map.has_value(); }

  static constexpr auto fields() {
    using R = Relief;
    return std::tuple{
        Field{"bump", &R::bump, Unit::none, Range::zero_to_one,
              "a texture whose brightness is the surface's height", true},
        Field{"bump_height", &R::bump_height, Unit::length, Range::not_negative,
              "the height of white above black", true},
        Field{"normal_map", &R::normal_map, Unit::none, Range::zero_to_one,
              "a texture of type image: red to the right, green up, blue outwards, 0.5 for none "
              "(OpenGL's way round)",
              true}};
  }
};

}  // namespace minkray
