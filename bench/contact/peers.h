// SPDX-License-Identifier: MIT
// Contestants for each query about a pair of shapes, at given placements. The lists begin with
// ours.
#pragma once

#include "bench/contact/contest.h"
#include "bench/contact/everybody.h"

namespace minkray::bench {

/// A pair of shapes and its placements. Contestants keep a reference to it.
struct Asked {
  const Everybody& a;
  const Everybody& b;
  std::vector<Placement> where;

  std::string name() const { return a.name + ", " + b.name; }
};

/// Distances; 0 of shapes that overlap.
std::vector<Contestant> distances(const Asked& asked);
/// Penetration depths, of pairs that overlap.
std::vector<Contestant> depths(const Asked& asked);
/// Times from 0 to 1 at which B, moving without turning, meets A; no answer if it does not.
std::vector<Contestant> impacts(const Asked& asked);

/// Contacts of other engines, with a margin: signed distances.
std::vector<Contestant> ode_contacts(const Asked& asked);
std::vector<Contestant> mujoco_contacts(const Asked& asked, double margin);

/// All placements' poses as a library has them.
template <class Pose>
struct Poses {
  std::vector<Pose> a, b, end;

  template <class Convert>
  Poses(const Asked& asked, Convert&& convert) {
    for (const Placement& placed : asked.where) {
      a.push_back(convert(placed.a));
      b.push_back(convert(placed.b));
      Affine<double> moved = placed.b;
      moved.translation += placed.motion;
      end.push_back(convert(moved));
    }
  }
};

}  // namespace minkray::bench
