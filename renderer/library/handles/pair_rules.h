// SPDX-License-Identifier: MIT
// Pairs of a scene's objects that are queried: by bit masks, without allowed pairs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>

namespace minkray {

class PairRules {
 public:
  struct Masks {
    std::uint32_t category = 1, mask = ~std::uint32_t{0};
  };

  void set_masks(std::uint32_t object, const Masks& masks) { masks_[object] = masks; }
  Masks masks(std::uint32_t object) const {
    const auto found = masks_.find(object);
    return found == masks_.end() ? Masks() : found->second;
  }

  /// A pair that is allowed to touch is skipped.
  void allow(std::uint32_t a, std::uint32_t b, bool is_allowed) {
    if (is_allowed)
      allowed_.insert(key(a, b));
    else
      allowed_.erase(key(a, b));
  }
  bool allows(std::uint32_t a, std::uint32_t b) const {
    return !allowed_.empty() && allowed_.contains(key(a, b));
  }

  /// Two objects that are a pair, by their masks, and are not allowed to touch.
  bool are_pair(std::uint32_t a, std::uint32_t b) const {
    if (allows(a, b)) return false;
    if (masks_.empty()) return true;
    const Masks of_a = masks(a), of_b = masks(b);
    return (of_a.category & of_b.mask) != 0 && (of_b.category & of_a.mask) != 0;
  }

 private:
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }

  std::unordered_map<std::uint32_t, Masks> masks_;
  std::unordered_set<std::uint64_t> allowed_;
};

}  // namespace minkray
