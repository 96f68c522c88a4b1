// SPDX-License-Identifier: MIT
// A pipeline: items are read one after another, processed in parallel, and written in their order.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace minkray {

/// Same as parallel_pipeline() below, for items of unspecified type.
void pipeline_of_any(std::size_t most, const std::function<std::shared_ptr<void>()>& read,
                     const std::function<void(void*)>& work,
                     const std::function<void(void*)>& write);

/// read() returns the next item as a shared_ptr<Item>, or null at the end. work(Item&) runs for
/// several items in parallel; write(Item&) runs for one item at a time, in the order of reading.
/// The pipeline holds at most `most` items at a time. An exception ends the pipeline and reaches
/// the caller.
template <class Item, class Read, class Work, class Write>
void parallel_pipeline(std::size_t most, const Read& read, const Work& work, const Write& write) {
  pipeline_of_any(
      most, [&]() -> std::shared_ptr<void> { return read(); },
      [&](void* item) { work(*static_cast<Item*>(item)); },
      [&](void* item) { write(*static_cast<Item*>(item)); });
}

}  // namespace minkray
