// SPDX-License-Identifier: MIT
// Selects the result of a cast from the results of its stages (solver.h). Takes the first result
// that needs no proof or is proven to the precision of double ("sharply"). Without such a
// result, takes the first one with a coarser proof.
#pragma once

#include <optional>

#include "core/cast/stages.h"
#include "core/proof/proven_cast.h"

namespace minkray {

class Judge {
 public:
  Judge(const StageQuestion& question, Proof proof) : question_(question), proof_(proof) {}

  /// Receives the result of a stage. Returns true if no further stage has to run.
  bool accepts(CastResult<double> answer);
  /// Same for a result of the stage `finer`, which must always be proven.
  bool accepts_finer(const CastResult<double>& answer);
  /// Runs last, for rays that just touch a rim or an edge. If a hit is unproven, tries to prove a
  /// hit at an earlier point of the ray, past an edge. Otherwise, if a stage did not converge but
  /// gave a plane, tries to prove a hit at the point where that stage stopped.
  void try_once_more();
  /// Returns the selected result, with the counts of all stages. Call once a stage was accepted or
  /// no stage is left.
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
