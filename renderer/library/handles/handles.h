// SPDX-License-Identifier: MIT
// Handles for other languages. Numbers are never reused, so a released or invalid one is detected.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace minkray {

/// Any number of threads may use it. Only the last owner's release must not be at once with a use
/// of the same thing.
template <class Thing>
class Handles {
 public:
  /// `kind` distinguishes the numbers of one kind of thing from those of another: less than 256.
  constexpr explicit Handles(std::uint64_t kind) : kind_(kind << 56) {}
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  /// The number of a new thing, with one owner.
  std::uint64_t add(std::unique_ptr<Thing> thing) {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) grow();
    const std::uint32_t index = free_.back();
    free_.pop_back();
    Slot& slot = slot_at(index);
    slot.thing = std::move(thing);
    slot.owners = 1;
    const std::uint64_t id = kind_ | (std::uint64_t{++slot.uses} << 32 & use_bits) | (index + 1u);
    slot.id.store(id, std::memory_order_release);
    return id;
  }

  /// Null if there is none of that number, or none any more.
  Thing* find(std::uint64_t id) const {
    const Slot* slot = slot_of(id);
    return slot ? slot->thing.get() : nullptr;
  }

  /// One more owner; false if there is no such thing.
  bool retain(std::uint64_t id) {
    const std::lock_guard lock(mutex_);
    Slot* slot = slot_of(id);
    if (slot) ++slot->owners;
    return slot != nullptr;
  }

  /// One owner less, with the last of whom the thing goes; false if there is no such thing.
  bool release(std::uint64_t id) {
    std::unique_ptr<Thing> last;  // goes when the lock is open: it may call a program back
    const std::lock_guard lock(mutex_);
    Slot* slot = slot_of(id);
    if (!slot) return false;
    if (--slot->owners == 0) last = emptied(*slot, id);
    return true;
  }

  /// Releases a thing with one owner, and returns it; null if there is no such thing.
  std::unique_ptr<Thing> take(std::uint64_t id) {
    const std::lock_guard lock(mutex_);
    Slot* slot = slot_of(id);
    return slot ? emptied(*slot, id) : nullptr;
  }

 private:
  static constexpr std::uint64_t use_bits = 0x00ffffff00000000u;
  static constexpr std::uint32_t first_chunk = 256;

  struct Slot {
    std::atomic<std::uint64_t> id = 0;
    std::unique_ptr<Thing> thing;
    std::uint32_t owners = 0, uses = 0;
  };

  std::unique_ptr<Thing> emptied(Slot& slot, std::uint64_t id) {
    slot.id.store(0, std::memory_order_seq_cst);
    // Numbers are not used again: a slot whose uses are used up stays empty.
    if ((std::uint64_t{slot.uses} << 32 & use_bits) != use_bits)
      free_.push_back(static_cast<std::uint32_t>(id) - 1u);
    return std::move(slot.thing);
  }

  static std::size_t chunk_of(std::uint32_t place) {
    const auto width = static_cast<int>(std::bit_width(place / first_chunk));
    return width > 1 ? static_cast<std::size_t>(width - 1) : 0;
  }

  /// Chunks double in size, and stay where they are.
  Slot& slot_at(std::uint32_t index) const {
    const std::uint32_t place = index + first_chunk;
    const std::size_t chunk = chunk_of(place);
    return chunks_[chunk].load(std::memory_order_acquire)[place - (first_chunk << chunk)];
  }

  Slot* slot_of(std::uint64_t id) const {
    const auto index = static_cast<std::uint32_t>(id) - 1u;
    if (id == 0 || index >= size_.load(std::memory_order_acquire)) return nullptr;
    Slot& slot = slot_at(index);
    return slot.id.load(std::memory_order_seq_cst) == id ? &slot : nullptr;
  }

  void grow() {
    const std::uint32_t size = size_.load();
    const std::size_t chunk = chunk_of(size + first_chunk);
    const std::uint32_t more = first_chunk << chunk;
    chunks_[chunk].store(new Slot[more], std::memory_order_release);
    size_.store(size + more, std::memory_order_release);
    for (std::uint32_t i = more; i-- > 0;) free_.push_back(size + i);
  }

  const std::uint64_t kind_;
  std::mutex mutex_;
  std::array<std::atomic<Slot*>, 24> chunks_ = {};
  std::atomic<std::uint32_t> size_ = 0;
  std::vector<std::uint32_t> free_;
};

/// Handles that are there before anything runs and are never destroyed: what a program still holds
/// when it ends may call back into what has ended.
template <class Thing>
union HandlesForEver {
  constexpr explicit HandlesForEver(std::uint64_t kind) : handles(kind) {}
  // The member has a destructor, so this one would be deleted by default.
  constexpr ~HandlesForEver() {}  // NOLINT(modernize-use-equals-default)
  Handles<Thing> handles;
};

}  // namespace minkray
