// SPDX-License-Identifier: MIT
// A shape that a program gives as a function: its support mapping, and nothing else. No file can
// hold one.
#pragma once

#include <array>
#include <memory>
#include <utility>

#include "core/math/vec.h"
#include "core/shape/declared.h"
#include "core/shape/field.h"
#include "core/shape/jet.h"

namespace minkray {

/// Three coordinates, as other languages have them.
using Coordinates = std::array<double, 3>;

/// A support mapping from elsewhere. Any number of threads ask at once; equal directions must get
/// equal points. Whatever goes wrong, the points must be finite: who gives the function keeps what
/// went wrong, and tells it when the query is done.
class SupportSource {
 public:
  virtual ~SupportSource();

  /// The points furthest along `count` directions, not more than `most`, which may be of any
  /// length; for zero, some point.
  void ask(std::size_t count, Coordinates* directions, Coordinates* points) const;

  static constexpr std::size_t most = 16;

 private:
  /// Answers `ask`, which has made the directions of unit length.
  virtual void support(std::size_t count, const Coordinates* directions,
                       Coordinates* points) const = 0;
};

template <class T>
struct Custom {
  std::shared_ptr<const SupportSource> source;

  static constexpr std::string_view name = "custom";
  static constexpr std::string_view doc = "A shape that a program gives by its support mapping.";
  static constexpr Declared declared = {.support_where = true, .by_program = true};
  static constexpr auto fields() { return std::tuple<>{}; }

  template <class U>
  Custom<U> cast() const {
    return {source};
  }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return support_where(Mask<W>(true), n);
  }

  /// In the lanes that are wanted; in others the point of the first that is.
  template <class W>
  Vec3<W> support_where(const Mask<W>& wanted, const Vec3<W>& n) const {
    if constexpr (std::floating_point<W>) {
      Coordinates direction = {double(n.x()), double(n.y()), double(n.z())}, point;
      source->ask(1, &direction, &point);
      return {W(point[0]), W(point[1]), W(point[2])};
    } else {
      constexpr std::size_t lanes = LaneOf<W>::count;
      static_assert(lanes <= SupportSource::most);
      Coordinates directions[lanes], points[lanes];
      std::size_t place[lanes], count = 0;
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const int i = static_cast<int>(lane);
        place[lane] = wanted.lane(i) ? count : 0;
        if (!wanted.lane(i)) continue;
        for (std::size_t k = 0; k < 3; ++k)
          directions[count][k] = double(n[static_cast<Eigen::Index>(k)].lane(i));
        ++count;
      }
      if (count == 0) return Vec3<W>::Zero();
      source->ask(count, directions, points);
      return per_lane<W>([&](int lane) {
        const Coordinates& point = points[place[lane]];
        return Vec3<Lane<W>>(Lane<W>(point[0]), Lane<W>(point[1]), Lane<W>(point[2]));
      });
    }
  }

  /// A vertex as far as anybody knows: casts learn of the surface point by point.
  template <class W>
  PointJet<W> jet(const Vec3<W>& n) const {
    return {support(n)};
  }
};

}  // namespace minkray
