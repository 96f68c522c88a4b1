// SPDX-License-Identifier: MIT
// Looking at eight pairs of a ray and a posed shape at once before any is cast at: in float lanes,
// each told that it surely misses, or where it meets at the earliest and at the latest. The closed
// forms are those of casts, with bounds for float (docs/theory.md, "Casts with an error bound");
// sizes are numbers of the lane, so that shapes of one kind go together whatever their sizes.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <vector>

#include "core/math/ray.h"
#include "core/model/shape_definition.h"

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
  /// What a position near the form is as large as, in the form's frame.
  float extent = 0;
  std::array<float, 3> offset = {};
  float up = 1;  ///< -1: upside down
};

/// A definition as it is screened: by its form or, where it has none for lanes, by its box.
struct Screen {
  ScreenForm form;
  FormKind kind = FormKind::none;  ///< none: it cannot be screened
  bool is_whole = false;           ///< the form is the shape, and not a box around it
  /// As it is screened where all lanes have one definition: polytopes by all their planes.
  FormKind alike = FormKind::none;
  ScreenForm alike_form;
  /// Rows of planes: normal, offset, depth.
  std::shared_ptr<const std::vector<float>> planes = {};
};

/// So many kinds of forms there are lanes for: a queue may be kept for each.
inline constexpr std::size_t form_kinds = static_cast<std::size_t>(FormKind::polytope) + 1;

template <class T>
Screen screen_of(const ShapeDefinition<T>& definition);

/// Rays, poses (PreparedShape's) and forms. Four numbers are read from `centre`.
template <class T>
struct ScreenPairs {
  std::array<const Ray<T>*, screen_lanes> ray;
  std::array<const Vec3<T>*, screen_lanes> centre;
  std::array<const Mat3<T>*, screen_lanes> to_inner;  ///< not null
  std::array<const ScreenForm*, screen_lanes> form;
};

/// Parameters of the ray. A lane that surely misses what lies ahead, whatever t_max, is entered at
/// infinity; one that is not sure to be met from outside is met at infinity at the latest.
struct alignas(32) Screened {
  std::array<float, screen_lanes> first, last;
};

/// Pairs of rays and of instances of one kind as they lie in memory (LanePlace in core/world).
template <class T>
struct ScreenList {
  const char* rays;  ///< the first ray; the others follow `stride` bytes after each other
  std::size_t stride;
  const char* places;
  const Screen* screens;
  const float* limits;  ///< by ray: what is met beyond that is of no interest
};

/// What came of them: bits of lanes that may be met up to their limit, and of those that surely are.
struct ScreenBits {
  std::uint32_t open, sure;
};

/// Rays that are looked at together at one instance: coordinate by coordinate, 32 of them.
struct alignas(32) ScreenBlock {
  double origin[3][32], direction[3][32];
  float t[32];  ///< limits
};

/// Only on machines that have AVX2 and FMA.
template <class T>
ScreenBits screen_list_avx2(FormKind kind, const ScreenList<T>& list, const std::uint32_t* rays,
                            const std::uint32_t* instances, Screened& answers);
/// Eight of the rays, from `first` on, at one instance.
template <class T>
ScreenBits screen_block_avx2(FormKind kind, const ScreenBlock& block, int first, const char* place,
                             const Screen* screens, Screened& answers);

/// All lanes are of one kind, not `none`; only on machines that have AVX2 and FMA.
void screen_avx2(FormKind kind, const ScreenPairs<float>& pairs, Screened& answers);
void screen_avx2(FormKind kind, const ScreenPairs<double>& pairs, Screened& answers);

extern template Screen screen_of(const ShapeDefinition<float>&);
extern template Screen screen_of(const ShapeDefinition<double>&);

}  // namespace minkray
