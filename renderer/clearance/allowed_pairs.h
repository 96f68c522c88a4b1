// SPDX-License-Identifier: MIT
// Pairs of links that may touch, whose distance is not queried.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "renderer/import/model/model.h"
#include "renderer/json/mistakes.h"

namespace minkray {

class AllowedPairs {
 public:
  void allow(const std::string& a, const std::string& b) { pairs_.insert(std::minmax(a, b)); }
  void forbid(const std::string& a, const std::string& b) { pairs_.erase(std::minmax(a, b)); }
  bool allows(const std::string& a, const std::string& b) const {
    return pairs_.contains(std::minmax(a, b));
  }
  std::size_t size() const { return pairs_.size(); }
  /// The lesser name first.
  const std::set<std::pair<std::string, std::string>>& pairs() const { return pairs_; }

 private:
  std::set<std::pair<std::string, std::string>> pairs_;
};

/// Adds the contents of an SRDF, MoveIt's description of a robot's meaning
/// (http://wiki.ros.org/srdf): <disable_collisions>, <disable_default_collisions> and
/// <enable_collisions>. Links that the model does not have are mistakes.
void read_srdf(const std::string& file, const Model& model, AllowedPairs& allowed,
               Mistakes& mistakes);

/// Links that no joint moves against each other have the same number: that of the first of them.
std::vector<int> rigid_groups(const Model& model);

}  // namespace minkray
