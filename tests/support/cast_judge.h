// SPDX-License-Identifier: MIT
// Compares results of casts with an oracle in long double: right ones, their errors, and those too
// near the silhouette to decide.
#pragma once

#include "core/derived/shape_bounds.h"
#include "core/math/ray.h"
#include "core/query/result.h"
#include "core/shape/shape.h"
#include "tests/oracle/line_entry.h"

namespace minkray::testing {

/// The greatest error of a hit that is allowed, along the normal, in units of R, the radius of the
/// ball around the shape's bounds.
constexpr double allowed_error = 1e-12;

enum class Verdict : unsigned char {
  right,
  exhausted,      ///< the cast did not converge
  undecided,      ///< the oracle did
  at_silhouette,  ///< a hit for a miss or the reverse, or entered elsewhere along a side
  wrong           ///< a hit for a miss or the reverse, further from the silhouette than the band
};

struct Judgement {
  Verdict verdict = Verdict::right;
  double error = 0;  ///< of a right hit: |t - exact| along the normal, in units of R
};

/// Entry of a ray's whole line into a shape.
struct TrueEntry {
  LineEntry entry;
  double cosine = 1;  ///< between the ray and the normal of a hit
};

class CastJudge {
 public:
  /// LineEntries must know the shape (else std::invalid_argument).
  explicit CastJudge(const Shape& shape);

  /// `normal`: the reported normal of a cast in double at the ray's entry. The oracle begins with
  /// it, and uses its cosine if a supporting plane proves that it is one of the normals there.
  TrueEntry truth(const Ray<double>& ray, const Vec3<double>& normal) const;

  /// `ray`: the ray that was cast, unbounded, from outside. The result's own normal, too, is
  /// accepted only if it is one at the ray's entry: next to an edge it may be of either side.
  Judgement operator()(const Ray<double>& ray, const CastResult<double>& answer,
                       const TrueEntry& truth) const;

  /// The error of a right hit by the bound that it claims: above 1, the interval does not contain
  /// the true t. The oracle's own error is taken off: it moves origins towards the shape, and
  /// shallow rays turn an error across the ray into a longer one along it. If the ray meets an
  /// edge, so that moving it by half an epsilon of R changes t beyond the interval's end,
  /// returns 1.
  double error_by_bound(const Ray<double>& ray, const CastResult<double>& answer,
                        const TrueEntry& truth) const;

 private:
  /// Entry of the ray after a move.
  TrueEntry truth(const Ray<double>& ray, const Vec3<long double>& move,
                  const Vec3<double>& normal) const;
  bool meets_edge(const Ray<double>& ray, long double end, bool is_upper) const;
  double cosine_at(const Ray<double>& ray, long double t, const Vec3<double>& normal) const;

  Shape shape_;
  Ball<double> ball_;
  LineEntries entries_;
};

}  // namespace minkray::testing
