// SPDX-License-Identifier: MIT
// Arrays of millions of entries that several threads fill. Entries are not initialised, so each
// page of memory is allocated only when a thread fills it. Pages are then allocated in parallel,
// and in memory near the thread. Large arrays use large pages if the system has them. Otherwise
// random reads spend half their time on address translation.
#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace minkray {

inline constexpr std::size_t large_page = std::size_t{1} << 21;  ///< bytes, on x86-64 and ARM64

/// Leaves new entries uninitialised if no value is given.
template <class T>
struct FirstTouchAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = FirstTouchAllocator<U>;
  };
  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (count > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    T* const at = static_cast<T*>(::operator new(bytes, std::align_val_t(alignment_of(bytes))));
#if defined(__linux__)
    // Only a hint: failure does no harm.
    if (bytes >= large_page) madvise(at, bytes, MADV_HUGEPAGE);
#endif
    return at;
  }
  void deallocate(T* at, std::size_t count) noexcept {
    ::operator delete(at, std::align_val_t(alignment_of(count * sizeof(T))));
  }

  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Values>
  void construct(U* at, Values&&... values) {
    std::construct_at(at, std::forward<Values>(values)...);
  }

 private:
  static constexpr std::size_t alignment_of(std::size_t bytes) {
    return bytes >= large_page ? large_page : alignof(T) > 64 ? alignof(T) : 64;
  }
};

/// `resize` leaves new entries uninitialised; write them before they are read. T needs no
/// destructor.
template <class T>
using FirstTouchVector = std::vector<T, FirstTouchAllocator<T>>;

}  // namespace minkray
