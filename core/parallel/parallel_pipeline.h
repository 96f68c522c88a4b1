// SPDX-License-Identifier: MIT
// Items pass through: made one after another, worked on at once, and taken in their order.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace minkray {

/// This is parallel_pipeline for items of any kind.
void pipeline_of_any(std::size_t most, const std::function<std::shared_ptr<void>()>& read,
                     const std::function<void(void*)>& work,
                     const std::function<void(void*)>& write);

/// read() -> shared_ptr<Item> makes the items, one at a time; none is the end. work(Item&) is
/// called for several items at once, write(Item&) for one at a time, in the order they were made
/// in. At most `most` items are on their way. An exception ends the pipeline and is passed on.
template <class Item, class Read, class Work, class Write>
void parallel_pipeline(std::size_t most, const Read& read, const Work& work, const Write& write) {
  pipeline_of_any(
      most, [&]() -> std::shared_ptr<void> { return read(); },
      [&](void* item) { work(*static_cast<Item*>(item)); },
      [&](void* item) { write(*static_cast<Item*>(item)); });
}

}  // namespace minkray
