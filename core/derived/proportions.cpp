// SPDX-License-Identifier: MIT
#include "core/derived/proportions.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/derived/shape_bounds.h"
#include "core/math/principal_axes.h"
#include "core/support/declared.h"

namespace minkray {
namespace {

/// Largest ratio of lengths for shapes along the axes. Their support points are products with each
/// axis' own length, so rounding is relative to that length.
constexpr double most_along_axes = 0x1p20;
/// Largest ratio for shapes given by points: these may be in any direction, so rounding is relative
/// to the largest length.
constexpr double most_askew = 0x1p12;

/// Largest ratio of size to rounding radius: with smaller radii, edges are nearly sharp.
constexpr double most_to_rounding = 0x1p20;

/// Ratio of the longest to the shortest length; 1 if there is only one. Lengths up to `flat` count
/// as zero.
double ratio_of(Vec3<long double> lengths, double flat) {
  std::sort(lengths.begin(), lengths.end());
  for (const long double length : lengths)
    if (length > flat) return double(lengths[2] / length);
  return 1;
}

/// Half extents of a box, in long double, since half of the least double is rounded to 0.
Vec3<long double> half_extents_of(const Bounds<double>& bounds) {
  return (bounds.upper.cast<long double>() - bounds.lower.cast<long double>()) / 2;
}

/// Half extents of the shape's bounding box. Slanted faces may be closer to each other than the
/// height of the bounding box, so their distance may replace the least length.
template <class S>
Vec3<long double> half_lengths_of(const S& shape) {
  Vec3<long double> lengths = half_extents_of(bounds_of(shape));
  if constexpr (declared_by<S>.slanted) {
    std::sort(lengths.begin(), lengths.end());
    lengths[0] = std::min(lengths[0], shape.half_thickness());
  }
  return lengths;
}

/// True if the points are collinear, up to the rounding of long double.
bool is_on_a_line(std::span<const Vec3<double>> points) {
  using Long = long double;
  const Vec3<Long> first = points[0].cast<Long>();
  Vec3<Long> along = Vec3<Long>::Zero();
  for (const Vec3<double>& p : points) {
    const Vec3<Long> edge = p.cast<Long>() - first;
    if (along.isZero(0)) along = edge;
    if (!along.cross(edge).isZero(0)) return false;
  }
  return true;
}

/// Extents of points along their principal axes.
struct Spread {
  double size = 0;                              ///< longest side of the bounding box
  Vec3<double> lengths = Vec3<double>::Zero();  ///< relative to the size, ascending
  double flat = 0;                              ///< lengths up to this are rounding
};

/// Scales the points by their size, so that squares stay in range.
Spread spread_of(std::span<const Vec3<double>> points) {
  Vec3<double> lower = points[0], upper = lower;
  for (const Vec3<double>& p : points) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  const double size = (upper - lower).maxCoeff();
  if (!(size > 0) || !std::isfinite(size)) return {size};
  // Positions are relative to the mean of the points. If all points are in a plane, so is the mean.
  Vec3<double> mean = Vec3<double>::Zero();
  for (const Vec3<double>& p : points) mean += (p - lower) / size;
  mean /= double(points.size());
  const auto scaled = [&](const Vec3<double>& p) -> Vec3<double> {
    return (p - lower) / size - mean;
  };
  Mat3<double> spread = Mat3<double>::Zero();
  for (const Vec3<double>& p : points) spread += scaled(p) * scaled(p).transpose();
  const Mat3<double> axes = principal_axes(spread / double(points.size())).axes;
  Vec3<double> least = axes.transpose() * scaled(points[0]), most = least;
  for (const Vec3<double>& p : points) {
    const Vec3<double> along = axes.transpose() * scaled(p);
    least = least.cwiseMin(along);
    most = most.cwiseMax(along);
  }
  constexpr double roundings = 64;  // of coordinates, a rotation, and rounded axes
  const double coordinate = std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff());
  const double flat = roundings * std::numeric_limits<double>::epsilon() * coordinate / size;
  Vec3<double> lengths = most - least;
  std::sort(lengths.begin(), lengths.end());
  return {size, lengths, flat};
}

/// True for points that are thinner than rounding in two directions, but not collinear.
bool is_lost_needle(const Spread& spread, std::span<const Vec3<double>> points) {
  return spread.lengths[1] <= spread.flat &&
         spread.lengths[1] * most_along_axes <= spread.lengths[2] && !is_on_a_line(points);
}

double ratio_of_points(std::span<const Vec3<double>> points) {
  const Spread spread = spread_of(points);
  if (!(spread.size > 0)) return 1;
  if (!std::isfinite(spread.size)) return spread.size;
  if (is_lost_needle(spread, points)) return std::numeric_limits<double>::infinity();
  return ratio_of(spread.lengths.cast<long double>(), spread.flat);
}

/// Largest and least factor by which maps scale lengths.
struct Stretch {
  double most = 1, least = 1;
  double ratio() const { return most / least; }
};

Stretch operator*(const Stretch& outer, const Mat3<double>& linear) {
  const double size = linear.cwiseAbs().maxCoeff();
  const Vec3<double> squares =
      principal_axes((linear / size).transpose() * (linear / size)).values.cwiseMax(0.0);
  return {outer.most * size * std::sqrt(squares[2]), outer.least * size * std::sqrt(squares[0])};
}

/// True if points are so close along an axis that products of this length and their size lose
/// digits. Planes through such points have errors larger than rounding.
bool loses_digits(const Bounds<double>& bounds) {
  const Vec3<long double> lengths = half_extents_of(bounds);
  constexpr long double least =
      std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
  const long double limit = least * lengths.maxCoeff();
  return std::any_of(lengths.begin(), lengths.end(),
                     [&](long double length) { return length > 0 && length < limit; });
}

/// Properties collected by the walk over a shape's operands.
struct Seen {
  bool extreme_operand = false, lost_digits = false, nearly_sharp = false;
  double longest = 0, shortest = std::numeric_limits<double>::infinity();
  double least_rounding = std::numeric_limits<double>::infinity();

  void add(double length, const Stretch& stretch) {
    longest = std::max(longest, length * stretch.most);
    if (length > 0) shortest = std::min(shortest, length * stretch.least);
  }
};

void look_at(const Shape& shape, const Stretch& stretch, Seen& seen) {
  const auto look_at_points = [&](const auto& kind, std::span<const Vec3<double>> points) {
    seen.extreme_operand |= ratio_of_points(points) * stretch.ratio() > most_askew;
    const Bounds<double> bounds = bounds_of(kind);
    seen.lost_digits |= loses_digits(bounds);
    seen.add(bounds.half_extents().maxCoeff(), stretch);
  };
  std::visit(
      [&]<class S>(const S& kind) {
        if constexpr (std::is_same_v<S, Transform>) {
          look_at(*kind.shape, stretch * kind.map.affine().linear, seen);
        } else if constexpr (std::is_same_v<S, Hull>) {
          look_at_points(kind, kind.points.points());
        } else if constexpr (std::is_same_v<S, Triangle> || std::is_same_v<S, Segment>) {
          look_at_points(kind, kind.points);
        } else if constexpr (std::is_same_v<S, Rounded>) {
          // Rounding by a large enough radius makes thin shapes thick enough.
          const double radius = kind.radius;
          const double size = bounds_of(*kind.shape).half_extents().maxCoeff();
          if (radius * most_askew > size) {
            Seen core;
            look_at(*kind.shape, stretch, core);
            seen.lost_digits |= core.lost_digits;
            seen.nearly_sharp |= core.nearly_sharp;
            seen.add(size + radius, stretch);
            seen.add(radius, stretch);
          } else {
            look_at(*kind.shape, stretch, seen);
            if (radius > 0)
              seen.least_rounding = std::min(seen.least_rounding, radius * stretch.least);
          }
        } else if constexpr (std::is_same_v<S, MinkowskiDifference>) {
          look_at(*kind.a, stretch, seen);
          look_at(*kind.b, stretch, seen);
        } else if constexpr (std::is_same_v<S, MinkowskiSum> || std::is_same_v<S, HullOf>) {
          for (const Nested& operand : kind.shapes) look_at(*operand, stretch, seen);
        } else {
          if constexpr (declared_by<S>.gauge) seen.nearly_sharp |= kind.is_nearly_sharp();
          const Vec3<long double> lengths = half_lengths_of(kind);
          // The rims of slanted faces are not along the axes.
          constexpr double most = declared_by<S>.slanted ? most_askew : most_along_axes;
          seen.extreme_operand |= ratio_of(lengths, 0) * stretch.ratio() > most;
          for (const long double length : lengths) seen.add(double(length), stretch);
        }
      },
      shape.kind);
}

}  // namespace

bool has_extreme_proportions(const Shape& shape) {
  Seen seen;
  look_at(shape, Stretch(), seen);
  return seen.extreme_operand || seen.lost_digits || seen.nearly_sharp ||
         seen.longest > most_along_axes * seen.shortest ||
         seen.longest > most_to_rounding * seen.least_rounding;
}

}  // namespace minkray
