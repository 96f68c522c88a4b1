// SPDX-License-Identifier: MIT
// Selects the result of a cast from those of its stages: the first that needs no proof or has a
// sharp proof, or else the first that has any proof.
#pragma once

#include <optional>

#include "core/cast/stages.h"
#include "core/proof/proven_cast.h"

namespace minkray {

class Judge {
 public:
  Judge(const StageQuestion& question, Proof proof) : question_(question), proof_(proof) {}

  /// True if no further stage has to run.
  bool accepts(CastResult<double> answer);
  /// Same as accepts(), for a result of the finer stage, which always has to be proven.
  bool accepts_finer(const CastResult<double>& answer);
  /// Runs last, for rays that just touch a rim or an edge. Tries to prove an unproven hit at a
  /// point before the claimed one, past an edge; otherwise tries to prove a hit where the last
  /// stage stopped that gave a plane but did not converge.
  void try_once_more();
  /// Returns the result once a stage was accepted or none is left, with the counts of all stages.
  CastResult<double> verdict() const;

 private:
  bool has_to_be_proven(const CastResult<double>& answer) const;
  bool is_sharply_proven(const CastResult<double>& answer, bool before = false);

  const StageQuestion& question_;
  Proof proof_;
  std::optional<CastResult<double>> accepted_, unproven_, given_up_;
  std::optional<ProvenCast> proven_;
  int iterations_ = 0, supports_ = 0;
};

}  // namespace minkray
