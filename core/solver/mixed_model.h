// SPDX-License-Identifier: MIT
// The model for shapes of several different pieces, one ray at a time: the hull model in the terms
// of the common loop.
#pragma once

#include "core/solver/hull_model.h"
#include "core/solver/line_cast.h"

namespace minkray {

template <class T, class S>
class MixedModel {
 public:
  struct Piece {
    HullPiece<T> in_radii;  ///< in units of R
    T R;
    T reach(const Vec3<T>& n) const {
      return R * (in_radii.exact ? in_radii.value(n) : in_radii.s.dot(n));
    }
    Vec3<T> spot(const Vec3<T>&) const { return in_radii.s * R; }
  };

  MixedModel(const S& shape, const Ball<T>& ball, const Vec3<T>& half_extents, const Vec3<T>& s,
             const Vec3<T>& r)
      : shape_(shape),
        s_(s),
        from_(ball.centre + s),
        R_(ball.radius),
        frame_(r),
        model_(into(Mat3<T>((half_extents / R_).asDiagonal()))) {}

  Vec3<T> to_frame(const Vec3<T>& n) const { return frame_.into(n); }
  Vec3<T> to_shape(const Vec3<T>& n) const { return frame_.out_of(n); }
  T against_ray(const Vec3<T>& n) const { return n.z(); }

  ModelHit<T> begin(const Vec3<T>& half_extents) const {
    ModelHit<T> hit;
    hit.m = frame_.into(normal_on_extents<T>(half_extents, s_, Vec3<T>(-frame_.z)));
    return hit;
  }

  Piece support(const Vec3<T>& n) const {
    const Jet<T> jet = shape_.jet(frame_.out_of(n));
    Piece piece{{}, R_};
    HullPiece<T>& p = piece.in_radii;
    p.c = frame_.into((jet.c - from_) / R_);
    p.F = into(Mat3<T>(jet.F / R_));
    p.exact = jet.exact;
    p.n = n;
    p.patch = p.c;
    const Vec3<T> g = p.F * unit<T>(p.F.transpose() * n);
    if (jet.exact) {
      p.s = p.c + g;
    } else {
      p.s = frame_.into((jet.s - from_) / R_);
      p.c = p.s - g;
    }
    return piece;
  }

  ModelHit<T> step(const Piece& piece, const Vec3<T>& n, int iteration) {
    ModelHit<T> hit;
    hit.repeated = model_.add(piece.in_radii);
    if (hit.repeated) shrink_ *= T(0.1);
    if (iteration >= 3) shrink_ *= T(0.5);
    HullSolution<T> solution = model_.solve(n, shrink_);
    if (!solution.certain && (solution.m - n).squaredNorm() <= tolerance::epsilon<T>) {
      model_.flatten_older();
      solution = model_.solve(n, shrink_);
    }
    hit.m = solution.m;
    hit.height = solution.height * R_;
    hit.certain = solution.certain;
    hit.inner = model_.is_exact(solution);
    model_.keep(solution);
    return hit;
  }

 private:
  Mat3<T> into(const Mat3<T>& F) const {
    Mat3<T> turned;
    for (int k = 0; k < 3; ++k) turned.col(k) = frame_.into(F.col(k));
    return turned;
  }

  const S& shape_;
  Vec3<T> s_, from_;
  T R_;
  RayFrame<T> frame_;
  HullModel<T> model_;
  T shrink_ = T(0.5);
};

}  // namespace minkray
