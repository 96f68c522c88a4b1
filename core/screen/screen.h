// SPDX-License-Identifier: MIT
// Screens eight pairs of a ray and a posed shape at once, before any cast: proves a miss, or bounds
// the hit's parameter from both sides. Uses the casts' closed forms in float lanes, with error
// bounds for float (docs/forms.md, "Casts with an error bound"). Each lane has its own sizes, so
// shapes of one kind but different sizes are screened together.
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

/// The numbers of an exact::Form (core/exact/form.h) as floats, for one lane.
struct alignas(64) ScreenForm {
  std::array<float, 4> sizes = {};
  float slope = 0, sine = 0;
  float R = 0;  ///< radius of a ball around the form, in the form's frame
  /// Least radius of curvature. The error bounds require that errors of positions are small
  /// relative to this radius and to R.
  float least = 0;
  std::array<float, 3> scale = {1, 1, 1};
  /// Largest magnitude of the form's coordinates, to which rounding errors are relative: (radius of
  /// the form + length of its offset) * greatest scale.
  float extent = 0;
  std::array<float, 3> offset = {};
  float up = 1;  ///< -1: upside down

  bool operator==(const ScreenForm&) const = default;
};

/// Planes of a polytope as floats, in rows of screen_lanes planes. A row has the planes' normals
/// (x, y, z), their offsets, and their offsets less their depth, the distance by which corners of
/// the face may be below the plane. The last row repeats its last plane.
struct ScreenPlanes {
  static constexpr std::size_t numbers = 5;
  static constexpr std::size_t most = 128;  ///< polytopes with more are screened by their box
  std::vector<float> rows;
  std::size_t count = 0;  ///< number of planes

  const float* row(std::size_t i) const { return rows.data() + i * numbers * screen_lanes; }
};

/// Screening data of a definition: its closed form, or a box around the shape if lanes do not
/// support the form.
struct Screen {
  ScreenForm form;
  FormKind kind = FormKind::none;  ///< none: the definition cannot be screened in lanes
  bool is_whole = false;  ///< true: `form` is the shape's own form; false: a box around the shape
  std::shared_ptr<const ScreenPlanes> planes = {};  ///< of a polytope
  std::uint32_t first_equal = 0;  ///< index of the first screen in the list that equals this one

  /// Shares the planes of another screen of the same definition and, if they are equal, its number.
  void share_with(const Screen& other) {
    if (planes && other.planes) planes = other.planes;
    if (kind == other.kind && is_whole == other.is_whole && form == other.form &&
        planes == other.planes)
      first_equal = other.first_equal;
  }
};

/// Makes the screening data of a definition. `centre` is the centre of definition.inner_ball(), the
/// bounding ball of the shape without outer transforms, in the frame to which InstancePlace maps.
Screen screen_of(const ShapeDefinition& definition, const Vec3<double>& centre);

/// Bounds of the hit's parameter in each lane. `first` is the lower bound; infinite if the ray
/// certainly misses, for any t_max. `last` is the upper bound; infinite unless the ray certainly
/// hits from outside.
struct alignas(32) Screened {
  std::array<float, screen_lanes> first, last;
};

/// Arrays of rays and instances. Pairs to screen are given as indices into these arrays.
struct ScreenList {
  const char* rays;             ///< Ray<double>
  std::size_t stride;           ///< distance between rays in bytes
  const InstancePlace* places;  ///< indexed by instance
  const Screen* screens;        ///< indexed by InstancePlace::body
  const float* limits;          ///< indexed by ray: hits at larger t are ignored
};

/// One bit per lane. `open`: the lane may hit up to its limit. `sure`: the lane certainly hits.
struct ScreenBits {
  std::uint32_t open, sure;
};

/// Screens `used` pairs, whose shapes all have the same kind other than `none`. The arrays have
/// screen_lanes items; those beyond `used` must be valid, and their results are not. Requires AVX2
/// and FMA.
ScreenBits screen_avx2(FormKind kind, const ScreenList& list, const std::uint32_t* rays,
                       const std::uint32_t* instances, std::size_t used, Screened& answers);

}  // namespace minkray
