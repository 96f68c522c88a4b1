// SPDX-License-Identifier: MIT
// Guarantees of every call of the C interface, for any input: a code, a message if it failed, and
// nothing written then.
#pragma once

#include <minkray/minkray_c.h>

#include <cstring>
#include <string>
#include <vector>

namespace minkray::fuzz {

/// Required result of a call: success, MINKRAY_WRONG_USE, or either of them.
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

  /// Allows MINKRAY_BAD_SUPPORT from every query, since an inconsistent support function is in
  /// use.
  void allow_bad_support() { has_liar_ = true; }

  /// Checks the result of a call; `untouched` is true if its results are unchanged, and
  /// `may_fail_with` is a code it may also return where it is not right. Returns true if it is OK.
  bool call(const char* function, int code, Sure sure, bool untouched,
            int may_fail_with = MINKRAY_WRONG_USE);

 private:
  std::string broken_;
  bool has_liar_ = false;
};

}  // namespace minkray::fuzz
