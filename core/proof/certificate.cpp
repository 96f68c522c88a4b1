// SPDX-License-Identifier: MIT
// Makes certificates of hits, misses and origins inside: tries several ways and keeps the best.
#include "core/proof/certificate.h"

#include <cmath>

#include "core/proof/proof_finder.h"
#include "core/query/tolerances.h"

namespace minkray {
namespace {

using proof::Finder;

/// The best proof so far.
struct Candidate {
  double off =
      std::numeric_limits<double>::infinity();  ///< distance of its point from the required place
  Certificate certificate;

  /// Keeps the finder's certificate if it is better. If it has no plane, its plane gets the normal
  /// n.
  void take(double other_off, const Vec3<double>& n, Finder& finder) {
    if (finder.certificate.plane.isZero(0)) finder.certificate.plane = n;
    if (!(other_off < off)) return;
    off = other_off;
    certificate = finder.certificate;
  }
  void give(Finder& finder) const {
    const int supports = finder.certificate.supports;
    finder.certificate = certificate;
    finder.certificate.supports = supports;
  }
};

/// Returns the unit vector with which the search begins.
Vec3<double> first_direction(const Claim& claim, const Vec3<double>& towards) {
  Vec3<double> normal = unit(claim.normal);
  if (normal.allFinite() && normal.squaredNorm() > 0) return normal;
  Vec3<double> other = unit(towards);
  return other.squaredNorm() > 0 ? other : Vec3<double>::UnitX();
}

/// Proves a hit with the normal n. First casts the ray again, which gives the tightest bounds. If
/// rounding decides what is hit (for rays that just touch, or run in a face), this may find another
/// hit. The proof is then a point of the shape at the claimed point, or slightly beyond it on the
/// ray: by rounding divided by the plane's slope. If the ray cast ended outside the shape, last
/// tries the points that it had reached.
void certify_hit(Finder& finder, const Claim& claim, const Vec3<double>& n) {
  const NearSegment& near = finder.near();
  const double claimed = near.lambda_of(claim.t_base, claim.t_offset);
  const double allowed = finder.rounding() * claim.epsilon / std::numeric_limits<double>::epsilon();
  const double slope = std::abs(n.dot(near.r));

  Candidate best;
  double lambda = near.begin;
  best.take(finder.enter(n, lambda), n, finder);
  const bool is_found = std::isfinite(best.off);
  const auto come_to = finder.certificate.spanning;
  const bool is_close =
      std::abs(lambda - claimed) * slope <= tolerance::proof_close_to_claim * allowed;
  if (is_close) {
    if (best.off <= tolerance::proof_good_enough * finder.rounding()) return best.give(finder);
    if (is_found) best.take(finder.refine(lambda, best.certificate.plane), n, finder);
    if (best.off <= tolerance::proof_good_enough * finder.rounding()) return best.give(finder);
  } else {
    best.off = std::numeric_limits<double>::infinity();
  }

  Vec3<double> separating = n;
  finder.certificate.plane = n;
  best.take(finder.nearest(claimed, claimed, n, separating), n, finder);
  if (best.off <= tolerance::proof_good_enough * allowed) return best.give(finder);
  finder.certificate.plane = n;
  best.take(finder.refine(claimed, n), n, finder);
  if (best.off <= tolerance::proof_good_enough * allowed) return best.give(finder);
  const double end = std::min(claimed + tolerance::proof_good_enough * allowed / slope, near.end);
  best.take(finder.nearest(claimed, end, n, separating), n, finder);
  if (!(best.off <= tolerance::proof_good_enough * allowed) && is_close && !is_found) {
    finder.certificate.spanning = come_to;
    finder.certificate.plane = n;
    best.take(finder.refine(lambda, n), n, finder);
  }
  best.give(finder);
}

}  // namespace

Certificate certify(const SupportFunction& support, const Ray<double>& ray, const Claim& claim) {
  Finder finder(support, ray);
  const NearSegment& near = finder.near();
  const Vec3<double> n = first_direction(claim, near.s);
  Vec3<double> separating = n;

  if (claim.status == Status::hit) certify_hit(finder, claim, n);
  if (claim.status == Status::inside) {
    const double origin = near.lambda_of(0, 0);
    Candidate best;
    best.take(finder.nearest(origin, origin, n, separating), separating, finder);
    // The search converges slowly if the origin is on a rim or a seam of the surface.
    if (!(best.off <= tolerance::proof_good_enough * finder.rounding()))
      best.take(finder.refine(origin, separating), separating, finder);
    best.give(finder);
  }
  if (claim.status == Status::miss && !(near.begin > near.end)) {
    const double margin =
        std::min(n.dot(near.at(near.begin)), n.dot(near.at(near.end))) - n.dot(finder.support(n));
    finder.certificate.plane = n;
    if (!(margin > 0)) {
      finder.nearest(near.begin, near.end, n, separating);
      finder.certificate.plane = separating;
    }
    finder.certificate.spanning = {};
  }
  return finder.certificate;
}

}  // namespace minkray
