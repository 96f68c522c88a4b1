// SPDX-License-Identifier: MIT
// Makes the nearest points of two cores, and their direction, more accurate than the distance's
// bounds require. For a core known only by its support mapping, the error of the direction is
// otherwise the square root of the gap between the bounds.
#pragma once

#include "core/pair/contact_shape.h"

namespace minkray {

/// Two cores along the world's axes, relative to A's middle.
struct CoresInWorld {
  const ShapeCore& a;
  const ShapeCore& b;
  Mat3<double> turn_a, turn_b;
  Between between;

  CoresInWorld(const ContactShape& shape_a, const Affine<double>& pose_a,
               const ContactShape& shape_b, const Affine<double>& pose_b)
      : a(shape_a.core()),
        b(shape_b.core()),
        turn_a(turn_in_world(shape_a, pose_a)),
        turn_b(turn_in_world(shape_b, pose_b)),
        between(between_middles(shape_a, pose_a, shape_b, pose_b)) {}

  Vec3<double> support_a(const Vec3<double>& n) const;
  Vec3<double> support_b(
      const Vec3<double>& n) const;  ///< B's furthest point along n, relative to A's middle
  double size() const { return a.ball + b.ball; }
  /// Error of support points.
  double rounding() const { return core_rounding * (size() + between.x.norm()) + between.loss; }
};

/// Nearest points of two cores: the point a of A, the vector c from a to the point of B, and the
/// unit normal from A to B.
struct CoreContact {
  Vec3<double> normal, a, c;
};

/// Improves a contact whose normal is nearly correct. Leaves the contact unchanged if no better one
/// is found.
void sharpen(const CoresInWorld& cores, CoreContact& contact);

/// Same where both surfaces are smooth and curved, or corners, even if they touch; uses the normal
/// only. Returns false for other contacts, and leaves them unchanged.
bool sharpen_curved(const CoresInWorld& cores, CoreContact& contact);

}  // namespace minkray
