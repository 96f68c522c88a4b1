// SPDX-License-Identifier: MIT
// The table: one row a figure, with the goal, whether it is met, how far answers agree, and a hash
// of ours.
#pragma once

#include <cstdio>

#include "casters.h"

namespace bench {

/// Minkray compared with a peer.
struct Duel {
  std::string what, rays;
  const Caster& ours;
  const Caster& peer;
  std::string peer_name;  ///< such as "Embree's spheres"; the kind of call is added
  std::size_t count = 1;  ///< of rays or queries
  double goal = 0;        ///< the least ratio peer / Minkray; 0: none
  Trust trust = {};       ///< in the peer's answers
};

/// Any other figure.
struct Figure {
  std::string what, rays, measured, peer;
  double value = 0, goal = 0;  ///< 0: none
  bool at_most = false;        ///< else at least
  Agreement agreement = {true, ""};
  std::uint32_t hash = 0;
};

class Table {
 public:
  explicit Table(std::FILE* out) : out_(out) {}
  static const char* head();
  void add(const Duel& duel);
  void add(const Figure& figure);

  bool all_good() const { return all_good_; }

 private:
  std::FILE* out_;
  bool all_good_ = true;
};

/// "100,000".
std::string with_commas(std::size_t number);

}  // namespace bench
