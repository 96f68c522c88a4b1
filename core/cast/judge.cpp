// SPDX-License-Identifier: MIT
#include "core/cast/judge.h"

#include "core/cast/in_precision.h"
#include "core/derived/convert.h"

namespace minkray {
namespace {

/// Proves a result with the query's shape and ray in double.
ProvenCast proven_in_double(const StageQuestion<double>& question, const CastResult<double>& answer,
                            bool before) {
  const PreparedShape<double>& shape = question.shape;
  return proven(shape.inner_shape(), shape.inner_ball(), question.near, answer, before);
}

ProvenCast proven_in_double(const StageQuestion<float>& question, const CastResult<double>& answer,
                            bool before) {
  const PreparedShape<float>& shape = question.shape;
  return proven(convert<double>(shape.inner_shape()), in_precision<double>(shape.inner_ball()),
                in_precision<double>(question.near), answer, before);
}

}  // namespace

template <class T>
bool Judge<T>::has_to_be_proven(const CastResult<T>& answer) const {
  if (proof_ == Proof::all) return true;
  return proof_ == Proof::steep_hits && answer.status == Status::hit &&
         -answer.normal.dot(question_.near.r) < question_.shape.definition().uncertain_slope();
}

template <class T>
bool Judge<T>::is_sharply_proven(const CastResult<double>& answer, bool before) {
  const ProvenCast cast = proven_in_double(question_, answer, before);
  iterations_ += cast.answer.iterations;
  supports_ += cast.answer.supports;
  if (!proven_ || cast.is_sharp || (cast.holds && !proven_->holds)) proven_ = cast;
  return cast.is_sharp;
}

template <class T>
bool Judge<T>::accepts(CastResult<T> answer) {
  if (answer.status != Status::exhausted) {
    // Every direction is a normal of a point.
    const bool is_point = !(question_.shape.inner_ball().radius > T(0));
    if (answer.status == Status::hit && (is_point || answer.normal.isZero(T(0))))
      answer.normal = -question_.near.r;
    if constexpr (std::is_same_v<T, double>)
      if (has_to_be_proven(answer)) {
        if (!unproven_) unproven_ = answer;
        return is_sharply_proven(answer);
      }
    accepted_ = answer;
  } else if (!answer.normal.isZero(T(0))) {
    given_up_ = answer;
  }
  iterations_ += answer.iterations;
  supports_ += answer.supports;
  return accepted_.has_value();
}

template <class T>
bool Judge<T>::accepts_finer(const CastResult<double>& answer) {
  if (answer.status != Status::exhausted) return is_sharply_proven(answer);
  iterations_ += answer.iterations;
  supports_ += answer.supports;
  return false;
}

template <class T>
void Judge<T>::try_once_more() {
  if (proven_ && proven_->holds) return;
  const bool before = unproven_ && unproven_->status == Status::hit;
  if (!before && (unproven_ || !given_up_)) return;
  CastResult<double> claim = in_precision<double>(before ? *unproven_ : *given_up_);
  claim.status = Status::hit;
  claim.iterations = claim.supports = 0;
  is_sharply_proven(claim, before);
}

template <class T>
CastResult<T> Judge<T>::verdict() const {
  CastResult<T> result;
  if (accepted_) {
    result = *accepted_;
  } else if (proven_) {
    // A near miss or touch of an ordinary shape is returned as it is if nothing better was found.
    const bool is_answered = proven_->holds || (unproven_ && proof_ != Proof::all);
    result = in_precision<T>(proven_->answer);
    result.path = Path::finer;
    if (!is_answered) result.status = Status::exhausted;
  }
  result.iterations = iterations_;
  result.supports = supports_;
  return result;
}

template class Judge<float>;
template class Judge<double>;

}  // namespace minkray
