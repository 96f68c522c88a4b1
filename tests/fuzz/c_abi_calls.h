// SPDX-License-Identifier: MIT
// What every call of the C interface promises, whatever it is given: a code, a text if it failed,
// and nothing written then.
#pragma once

#include <minkray/minkray_c.h>

#include <cstring>
#include <string>
#include <vector>

namespace minkray::fuzz {

/// Whether a call must succeed, must say MINKRAY_WRONG_USE, or may do one or the other.
enum class Sure { right, wrong, either };

inline Sure both(Sure a, Sure b) {
  if (a == Sure::wrong || b == Sure::wrong) return Sure::wrong;
  return a == Sure::right && b == Sure::right ? Sure::right : Sure::either;
}
inline Sure right_if(bool is_right) {
  return is_right ? Sure::right : Sure::wrong;
}

/// Memory for answers, filled with what no answer is.
template <class T>
class Answers {
 public:
  explicit Answers(std::size_t count = 1) : values_(count + 1), count_(count) {
    std::memset(static_cast<void*>(values_.data()), pattern, values_.size() * sizeof(T));
  }

  T* data() { return values_.data(); }
  const T& operator[](std::size_t i) const { return values_[i]; }
  std::size_t size() const { return count_; }
  bool is_untouched() const { return is_pattern(0); }
  /// Nothing was written behind the last one.
  bool is_kept_behind() const { return is_pattern(count_); }
  bool operator==(const Answers& other) const {
    return std::memcmp(values_.data(), other.values_.data(), count_ * sizeof(T)) == 0;
  }

 private:
  static constexpr unsigned char pattern = 0xa5;

  bool is_pattern(std::size_t first) const {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values_.data());
    for (std::size_t i = first * sizeof(T); i < values_.size() * sizeof(T); ++i)
      if (bytes[i] != pattern) return false;
    return true;
  }

  std::vector<T> values_;
  std::size_t count_;
};

/// Keeps the first promise that was broken.
class Promises {
 public:
  const std::string& broken() const { return broken_; }
  void expect(bool holds, const std::string& otherwise) {
    if (!holds && broken_.empty()) broken_ = otherwise;
  }

  /// A support function that lies is in the game: whatever is asked may say so.
  void allow_bad_support() { has_liar_ = true; }

  /// Looks at what a call answered; `untouched` says whether its results are what they were, and
  /// `may_fail_with` which code it may also have where it is not right. Answers whether it is OK.
  bool call(const char* function, int code, Sure sure, bool untouched,
            int may_fail_with = MINKRAY_WRONG_USE);

 private:
  std::string broken_;
  bool has_liar_ = false;
};

}  // namespace minkray::fuzz
