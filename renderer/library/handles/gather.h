// SPDX-License-Identifier: MIT
// Batches calls of an expensive support function over many directions. Each piece of work runs on
// its own stack and pauses when it requests support points; when all pieces pause, one call serves
// all. Solvers are unaware, and results are the same.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "core/shape/custom.h"

namespace minkray {

/// A source of support points in batches.
class BatchSource {
 public:
  virtual ~BatchSource() = default;
  virtual void answer(std::size_t count, const Coordinates* directions,
                      Coordinates* points) const = 0;
  /// Largest number of directions per call; 0 if they are not to be gathered.
  virtual std::size_t most_at_once() const = 0;
};

/// Any number of threads may use it at once.
class Gathering {
 public:
  Gathering();
  ~Gathering();
  Gathering(const Gathering&) = delete;
  Gathering& operator=(const Gathering&) = delete;

  /// Calls work(i) for all i < count on this thread, some of them in turns. Throws what one of them
  /// throws.
  void run(std::size_t count, const std::function<void(std::size_t)>& work);

  /// Within a task of `run`: the source's result, once other tasks have requested theirs as well.
  /// Returns false, and does nothing, anywhere else.
  static bool wait(const BatchSource& source, std::size_t count, const Coordinates* directions,
                   Coordinates* points);

 private:
  class Turns;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Turns>> idle_;
};

}  // namespace minkray
