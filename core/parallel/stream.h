// SPDX-License-Identifier: MIT
// Things that stream by: made one after another, worked on at once, and taken in their order.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace minkray {

/// See stream(), of things of any kind.
void stream_of_any(std::size_t most, const std::function<std::shared_ptr<void>()>& read,
                   const std::function<void(void*)>& work, const std::function<void(void*)>& write);

/// read() -> shared_ptr<Item> makes the items, one at a time; none is the end. work(Item&) is
/// called for several items at once, write(Item&) for one at a time, in the order they were made
/// in. At most `most` items are on their way. An exception ends the stream and is passed on.
template <class Item, class Read, class Work, class Write>
void stream(std::size_t most, const Read& read, const Work& work, const Write& write) {
  stream_of_any(
      most, [&]() -> std::shared_ptr<void> { return read(); },
      [&](void* item) { work(*static_cast<Item*>(item)); },
      [&](void* item) { write(*static_cast<Item*>(item)); });
}

}  // namespace minkray
