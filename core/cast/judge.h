// SPDX-License-Identifier: MIT
// Selects which result of a cast's stages to believe: the first that needs no proof, or has a
// sharp one; else the first that has any.
#pragma once

#include <optional>

#include "core/cast/stages.h"
#include "core/proof/proven_cast.h"

namespace minkray {

template <class T>
class Judge {
 public:
  Judge(const StageQuestion<T>& question, Proof proof) : question_(question), proof_(proof) {}

  /// True if no further stage has to run.
  bool accepts(CastResult<T> answer);
  /// Does what accepts() does with an answer in wider numbers, which always has to be proven.
  bool accepts_finer(const CastResult<double>& answer);
  /// Runs last, for rims and edges that are just touched. A proof decides whether an unproven hit
  /// is really one before the claimed point, past an edge, or else whether the last stage that
  /// failed to converge with a plane did so at a hit.
  void try_once_more();
  /// The result once a stage was accepted, or none is left; with the work of all stages.
  CastResult<T> verdict() const;

 private:
  bool has_to_be_proven(const CastResult<T>& answer) const;
  bool is_sharply_proven(const CastResult<double>& answer, bool before = false);

  const StageQuestion<T>& question_;
  Proof proof_;
  std::optional<CastResult<T>> accepted_, unproven_, given_up_;
  std::optional<ProvenCast> proven_;
  int iterations_ = 0, supports_ = 0;
};

extern template class Judge<float>;
extern template class Judge<double>;

}  // namespace minkray
