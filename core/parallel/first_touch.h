// SPDX-License-Identifier: MIT
// Arrays of millions of entries that several threads fill: no entry is written before, so that
// pages are allocated when they are filled, near to the thread that fills them and from all
// threads at once.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace minkray {

/// Leaves new entries unwritten where no value is given.
template <class T>
struct FirstTouchAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = FirstTouchAllocator<U>;
  };
  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Values>
  void construct(U* at, Values&&... values) {
    std::construct_at(at, std::forward<Values>(values)...);
  }
};

/// `resize` leaves what is new to be written before it is read. T needs no destructor.
template <class T>
using FirstTouchVector = std::vector<T, FirstTouchAllocator<T>>;

}  // namespace minkray
