// SPDX-License-Identifier: MIT
// A shape defined by a support mapping that the calling program supplies as a function. Scene files
// cannot contain such shapes.
#pragma once

#include <array>
#include <memory>
#include <utility>

#include "core/math/vec.h"
#include "core/support/declared.h"
#include "core/support/field.h"
#include "core/support/jet.h"

namespace minkray {

/// Three coordinates as a plain array, for the interfaces to other languages.
using Coordinates = std::array<double, 3>;
/// A 3 x 3 matrix, row by row.
using Derivative = std::array<double, 9>;

/// A support mapping supplied by the caller. Several threads may call it at once. Equal directions
/// must give equal points. Points must be finite even after an error: an implementation stores the
/// error and reports it after the query.
class SupportSource {
 public:
  virtual ~SupportSource();

  /// Computes the shape's furthest points along `count` directions of any length; `count` is at
  /// most `most`. For a zero direction, the result is any point of the shape.
  void ask(std::size_t count, Coordinates* directions, Coordinates* points) const;

  /// True if the source also provides derivatives of the points with respect to the direction, and
  /// a point inside the shape, which middle() returns.
  bool has_jets() const { return has_jets_; }
  const Coordinates& middle() const { return middle_; }
  /// Jet in one direction (core/support/jet.h), as plain numbers: an ellipsoid if `curved`,
  /// otherwise a point.
  struct JetNumbers {
    bool curved = false;
    Coordinates point = {0, 0, 0};
    Derivative factor = {};  ///< factor F of the ellipsoid, whose centre is middle()
  };
  /// Computes the jet from the support point and its derivative, a symmetric matrix. Casts use jets
  /// only as a guide, so wrong derivatives only cost time.
  JetNumbers jet_along(Coordinates direction) const;

  static constexpr std::size_t most = 16;  ///< maximum `count` of ask()

 protected:
  /// Declares that the source provides jets, and the point inside the shape.
  void know_jets(const Coordinates& middle) {
    has_jets_ = true;
    middle_ = middle;
  }

 private:
  /// Implements `ask`, which calls this function with unit directions.
  virtual void support(std::size_t count, const Coordinates* directions,
                       Coordinates* points) const = 0;
  /// Computes points and their derivatives for jet_along(). Called only on objects that have called
  /// know_jets().
  virtual void jets(std::size_t count, const Coordinates* directions, Coordinates* points,
                    Derivative* derivatives) const;

  bool has_jets_ = false;
  Coordinates middle_ = {0, 0, 0};
};

struct Custom {
  std::shared_ptr<const SupportSource> source;

  static constexpr std::string_view name = "custom";
  static constexpr std::string_view doc = "A shape that a program gives by its support mapping.";
  static constexpr Declared declared = {.support_where = true, .by_program = true};
  static constexpr auto fields() { return std::tuple<>{}; }

  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return support_where(Mask<W>(true), n);
  }

  /// Returns support points in the wanted lanes. Other lanes get the point of the first wanted
  /// lane.
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

  /// Returns the ellipsoid around middle() whose support point has the same derivative; a single
  /// point if the source has no derivatives.
  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    if (!source->has_jets()) return PointJet<W>{support(n)};
    constexpr std::size_t lanes = LaneOf<W>::count;
    std::array<SupportSource::JetNumbers, lanes> jets;
    if constexpr (std::floating_point<W>) {
      jets[0] = source->jet_along({double(n.x()), double(n.y()), double(n.z())});
    } else {
      for (int lane = 0; lane < static_cast<int>(lanes); ++lane)
        jets[std::size_t(lane)] = source->jet_along(
            {double(n.x().lane(lane)), double(n.y().lane(lane)), double(n.z().lane(lane))});
    }
    const auto in_lanes = [&](const auto& of) -> Vec3<W> {
      if constexpr (std::floating_point<W>) {
        const Coordinates v = of(jets[0]);
        return {W(v[0]), W(v[1]), W(v[2])};
      } else {
        return per_lane<W>([&](int lane) {
          const Coordinates v = of(jets[std::size_t(lane)]);
          return Vec3<Lane<W>>(Lane<W>(v[0]), Lane<W>(v[1]), Lane<W>(v[2]));
        });
      }
    };
    using Numbers = SupportSource::JetNumbers;
    Jet<W> jet;
    jet.s = in_lanes([](const Numbers& one) { return one.point; });
    jet.c = in_lanes([&](const Numbers& one) { return one.curved ? source->middle() : one.point; });
    for (std::size_t k = 0; k < 3; ++k)
      jet.F.row(static_cast<Eigen::Index>(k)) = in_lanes([&](const Numbers& one) {
        return Coordinates{one.factor[3 * k], one.factor[3 * k + 1], one.factor[3 * k + 2]};
      });
    const Vec3<W> curved = in_lanes([](const Numbers& one) {
      return Coordinates{one.curved ? 1.0 : 0.0, 0, 0};
    });
    jet.exact = curved.x() == W(0);
    return jet;
  }
};

}  // namespace minkray
