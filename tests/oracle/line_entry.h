// SPDX-License-Identifier: MIT
// Finds where lines enter a shape, in long double, fast enough for tens of millions of lines.
// Shares no code with the solvers.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/shape/shape.h"
#include "tests/oracle/half_spaces.h"

namespace minkray::testing {

struct LineEntry {
  enum class Answer : unsigned char { hit, miss, undecided } answer = Answer::undecided;
  long double t = 0;  ///< of a hit
};

/// Prepared once for many lines at the same shape, whose numbers are taken as exact:
/// - those of tests/oracle/closed_form.h by school geometry;
/// - hulls of points by clipping with the planes of all their facets;
/// - hulls and boxes, rounded, and boxes plus an ellipsoid along the axes (rounded by 1 in units of
///   its radii): as unions of prisms over the facets, cylinders around edges, balls at corners;
/// - sums of two ellipsoids between a supporting plane and the ball within the sum that touches it
///   there, whose radius is the sum of the ellipsoids' least radii of curvature (Blaschke's rolling
///   theorem). The start is supplied by the caller and need not be trusted, as nothing but the
///   two bounds decides.
class LineEntries {
 public:
  using Long = long double;

  /// std::invalid_argument for shapes that are none of these.
  explicit LineEntries(const Shape& shape);

  /// Enters by the whole line, t of any sign, for origins outside and near the shape. `normal` is
  /// where to begin with sums of ellipsoids: a guess at the outward normal of the hit, or of a
  /// plane that separates. The better, the faster.
  LineEntry operator()(const Vec3<Long>& origin, const Vec3<Long>& direction,
                       const Vec3<double>& normal) const {
    return enter_(origin, direction, normal);
  }

 private:
  std::function<LineEntry(const Vec3<Long>&, const Vec3<Long>&, const Vec3<double>&)> enter_;
};

}  // namespace minkray::testing
