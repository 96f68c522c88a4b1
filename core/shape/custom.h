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
/// A matrix of 3 x 3, row by row.
using Derivative = std::array<double, 9>;

/// A support mapping from elsewhere. Any number of threads ask at once; equal directions must get
/// equal points. Whatever goes wrong, the points must be finite: who gives the function keeps what
/// went wrong, and tells it when the query is done.
class SupportSource {
 public:
  virtual ~SupportSource();

  /// The points furthest along `count` directions, not more than `most`, which may be of any
  /// length; for zero, some point.
  void ask(std::size_t count, Coordinates* directions, Coordinates* points) const;

  /// Whether it knows how its points move as directions turn; with a point in the shape's middle.
  bool has_jets() const { return has_jets_; }
  const Coordinates& middle() const { return middle_; }
  /// The same as `ask`, and the derivatives of the points by their directions of unit length, which
  /// are symmetric. Casts are guided by them, and believe nothing: wrong ones cost time.
  void ask_jets(std::size_t count, Coordinates* directions, Coordinates* points,
                Derivative* derivatives) const;

  static constexpr std::size_t most = 16;

 protected:
  void know_jets(const Coordinates& middle) {
    has_jets_ = true;
    middle_ = middle;
  }

 private:
  /// Answers `ask`, which has made the directions of unit length.
  virtual void support(std::size_t count, const Coordinates* directions,
                       Coordinates* points) const = 0;
  /// Answers `ask_jets`; asked only of those that have called know_jets.
  virtual void jets(std::size_t count, const Coordinates* directions, Coordinates* points,
                    Derivative* derivatives) const;

  bool has_jets_ = false;
  Coordinates middle_ = {0, 0, 0};
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

  /// A vertex as far as anybody knows, and casts learn of the surface point by point; or, of a
  /// function that knows more, the ellipsoid around the middle that has its derivative.
  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    if (!source->has_jets()) return PointJet<W>{support(n)};
    if constexpr (std::floating_point<W>) {
      return jet_of_one(n);
    } else {
      using T1 = Lane<W>;
      std::array<Jet<T1>, LaneOf<W>::count> jets;
      for (std::size_t lane = 0; lane < jets.size(); ++lane) {
        const int i = static_cast<int>(lane);
        jets[lane] = jet_of_one(Vec3<T1>(n.x().lane(i), n.y().lane(i), n.z().lane(i)));
      }
      const auto of = [&](int lane) -> const Jet<T1>& { return jets[std::size_t(lane)]; };
      Jet<W> jet;
      jet.c = per_lane<W>([&](int lane) { return of(lane).c; });
      jet.s = per_lane<W>([&](int lane) { return of(lane).s; });
      for (int k = 0; k < 3; ++k)
        jet.F.col(k) = per_lane<W>([&](int lane) { return Vec3<T1>(of(lane).F.col(k)); });
      const Vec3<W> exact =
          per_lane<W>([&](int lane) { return Vec3<T1>(T1(of(lane).exact ? 1 : 0), T1(0), T1(0)); });
      jet.exact = exact.x() > W(0);
      return jet;
    }
  }

 private:
  template <class W>
  Jet<W> jet_of_one(const Vec3<W>& n) const {
    Coordinates direction = {double(n.x()), double(n.y()), double(n.z())}, point;
    Derivative derivative;
    source->ask_jets(1, &direction, &point, &derivative);
    const Coordinates& c = source->middle();
    const Vec3<double> s(point[0], point[1], point[2]), middle(c[0], c[1], c[2]), g = s - middle;
    const double reach = Vec3<double>(direction[0], direction[1], direction[2]).dot(g);
    Mat3<double> H;
    H << derivative[0], derivative[1], derivative[2],  //
        derivative[3], derivative[4], derivative[5],   //
        derivative[6], derivative[7], derivative[8];
    const bool is_curved = reach > 0 && H.allFinite() && !H.isZero(0);
    if (!is_curved) return PointJet<W>{s.template cast<W>()};
    const Mat3<double> F = factor<double>(Mat3<double>(reach * H + g * g.transpose()));
    return {middle.template cast<W>(), F.template cast<W>(), false, s.template cast<W>()};
  }
};

}  // namespace minkray
