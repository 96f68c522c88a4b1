// SPDX-License-Identifier: MIT
// Screens eight pairs of a ray and a posed shape at once before any cast: each surely misses, or
// is met between two parameters. The closed forms are those of casts, in float lanes with bounds
// for float (docs/forms.md, "Casts with an error bound"); sizes are numbers of the lane, so that
// shapes of one kind go together whatever their sizes.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "core/math/ray.h"
#include "core/model/shape_definition.h"
#include "core/screen/instance_place.h"

namespace minkray {

inline constexpr int screen_lanes = 8;

/// A form's numbers as a lane takes them: those of exact::Form.
struct alignas(64) ScreenForm {
  std::array<float, 4> sizes = {};
  float slope = 0, sine = 0, R = 0;
  /// The bounds hold where positions are known to a small share of it: the least radius of what is
  /// round, and R.
  float least = 0;
  std::array<float, 3> scale = {1, 1, 1};
  /// Magnitude of positions near the form, in the form's frame.
  float extent = 0;
  std::array<float, 3> offset = {};
  float up = 1;  ///< -1: upside down
};

/// A definition for screening in lanes: its form or, where lanes have none for it, a box around
/// it.
struct Screen {
  ScreenForm form;
  FormKind kind = FormKind::none;  ///< none: lanes cannot screen it
  bool is_whole = false;           ///< the form is the shape, and not a box around it
  /// Five floats per plane of a polytope: normal, offset, depth.
  std::shared_ptr<const std::vector<float>> planes = {};
};

/// Number of kinds of forms that lanes support.
inline constexpr std::size_t form_kinds = static_cast<std::size_t>(FormKind::polytope) + 1;

/// `centre`: of the inner ball, from the origin of the places' frame.
Screen screen_of(const ShapeDefinition<double>& definition, const Vec3<double>& centre);

/// Parameters of the ray. A lane that surely misses what lies ahead, whatever t_max, is entered at
/// infinity; one that is not sure to be met from outside is met at infinity at the latest.
struct alignas(32) Screened {
  std::array<float, screen_lanes> first, last;
};

/// Rays and places, to which pairs refer by index.
struct ScreenList {
  const char* rays;    ///< Ray<double>
  std::size_t stride;  ///< from one ray to the next, in bytes
  const InstancePlace* places;
  const Screen* screens;  ///< by body
  const float* limits;    ///< by ray: nothing beyond is of interest
};

/// Bits of lanes that may be met up to their limit, and of those that surely are.
struct ScreenBits {
  std::uint32_t open, sure;
};

/// Screens eight pairs, all of one kind other than `none`; on machines that have AVX2 and FMA.
ScreenBits screen_avx2(FormKind kind, const ScreenList& list, const std::uint32_t* rays,
                       const std::uint32_t* instances, Screened& answers);

}  // namespace minkray
