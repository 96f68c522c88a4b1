// SPDX-License-Identifier: MIT
// Computes the convex hull of points and, as the dual problem, the vertices of an intersection of
// half-spaces. Solid hulls use Qhull (Barber, Dobkin and Huhdanpaa, "The Quickhull Algorithm for
// Convex Hulls", 1996), which only convex_hull.cpp includes. Flat hulls use Andrew's monotone chain
// (1979).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

/// Polygons as consecutive lists of indices.
struct Polygons {
  /// Index into `corners` of each polygon's first corner. The last item is the number of all
  /// corners.
  std::vector<std::uint32_t> begin = {0};
  std::vector<std::uint32_t> corners;

  std::size_t size() const { return begin.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t i) const {
    return std::span(corners).subspan(begin[i], begin[i + 1] - begin[i]);
  }
  template <class Corners>
  void add(const Corners& polygon) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    begin.push_back(static_cast<std::uint32_t>(corners.size()));
  }
};

/// A frame in which a set of points has about equal extents. The axes are orthogonal; the first is
/// along the longest extent. Hulls are affine invariant, so they can be computed in this frame.
struct RoundFrame {
  Vec3<double> origin = Vec3<double>::Zero();    ///< one of the points
  Mat3<double> axes = Mat3<double>::Identity();  ///< columns of unit length
  Vec3<double> extents = Vec3<double>::Ones();   ///< along the axes; 1 instead of 0
  int rank = 0;  ///< 3 solid, 2 in a plane, 1 on a line, 0 a single point

  /// Converts a point to the frame, where the set spans about [-1, 1] along each axis.
  Vec3<double> to_frame(const Vec3<double>& point) const {
    return (axes.transpose() * (point - origin)).cwiseQuotient(extents);
  }
  Vec3<double> from_frame(const Vec3<double>& q) const {
    return origin + axes * q.cwiseProduct(extents);
  }
};

/// Returns the frame of one or more finite points. Extents of at most `flatness` times the largest
/// extent, or within the rounding of the coordinates, count as zero.
RoundFrame round_frame(std::span<const Vec3<double>> points, double flatness = 0);

struct ConvexHull {
  RoundFrame frame;
  /// The extreme points, as ascending indices into the input. Equal points are kept once.
  std::vector<std::uint32_t> vertices;
  /// Rank 3: the facets, counter-clockwise from outside, with coplanar neighbours merged. Rank 2:
  /// one polygon. Corners are indices into `vertices`.
  Polygons facets;

  int rank() const { return frame.rank; }
};

/// Returns the hull of one or more finite points. A set thinner than the rounding of its
/// coordinates counts as flat. For other sets, a point is omitted only if it lies in the hull of
/// the others, up to rounding. Throws std::runtime_error if Qhull fails, or if distances between
/// the points overflow.
ConvexHull convex_hull(std::span<const Vec3<double>> points);

/// The points x with normal.x <= offset.
struct HalfSpace {
  Vec3<double> normal;
  double offset;
};

/// Returns the vertices of a bounded intersection of half-spaces. `interior` must be clearly inside
/// all half-spaces. Half-spaces whose planes do not touch the intersection are allowed. Throws
/// std::runtime_error if Qhull fails or the intersection is not bounded.
std::vector<Vec3<double>> intersection_vertices(std::span<const HalfSpace> half_spaces,
                                                const Vec3<double>& interior);

}  // namespace minkray
