// SPDX-License-Identifier: MIT
#include "core/cast/judge.h"

namespace minkray {
bool Judge::has_to_be_proven(const CastResult<double>& answer) const {
  if (proof_ == Proof::all) return true;
  return proof_ == Proof::steep_hits && answer.status == Status::hit &&
         -answer.normal.dot(question_.near.r) < question_.shape.definition().uncertain_slope();
}

bool Judge::is_sharply_proven(const CastResult<double>& answer, bool before) {
  const PreparedShape& shape = question_.shape;
  const ProvenCast cast =
      proven(shape.inner_shape(), shape.inner_ball(), question_.near, answer, before);
  iterations_ += cast.answer.iterations;
  supports_ += cast.answer.supports;
  if (!proven_ || cast.is_sharp || (cast.holds && !proven_->holds)) proven_ = cast;
  return cast.is_sharp;
}

bool Judge::accepts(CastResult<double> answer) {
  if (answer.status != Status::exhausted) {
    // For a point, every direction is a normal.
    const bool is_point = !(question_.shape.inner_ball().radius > 0.0);
    if (answer.status == Status::hit && (is_point || answer.normal.isZero(0)))
      answer.normal = -question_.near.r;
    if (has_to_be_proven(answer)) {
      if (!unproven_) unproven_ = answer;
      return is_sharply_proven(answer);
    }
    accepted_ = answer;
  } else if (!answer.normal.isZero(0)) {
    given_up_ = answer;
  }
  iterations_ += answer.iterations;
  supports_ += answer.supports;
  return accepted_.has_value();
}

bool Judge::accepts_finer(const CastResult<double>& answer) {
  if (answer.status != Status::exhausted) return is_sharply_proven(answer);
  iterations_ += answer.iterations;
  supports_ += answer.supports;
  return false;
}

void Judge::try_once_more() {
  if (proven_ && proven_->holds) return;
  const bool before = unproven_ && unproven_->status == Status::hit;
  if (!before && (unproven_ || !given_up_)) return;
  CastResult<double> claim = before ? *unproven_ : *given_up_;
  claim.status = Status::hit;
  claim.iterations = claim.supports = 0;
  is_sharply_proven(claim, before);
}

CastResult<double> Judge::verdict() const {
  CastResult<double> result;
  if (accepted_) {
    result = *accepted_;
  } else if (proven_) {
    // For ordinary shapes, an unproven result (a near miss or a touch) is returned as it is.
    const bool is_answered = proven_->holds || (unproven_ && proof_ != Proof::all);
    result = proven_->answer;
    result.path = Path::finer;
    if (!is_answered) result.status = Status::exhausted;
  }
  result.iterations = iterations_;
  result.supports = supports_;
  return result;
}

}  // namespace minkray
