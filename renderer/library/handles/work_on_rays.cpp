// SPDX-License-Identifier: MIT
#include "renderer/library/handles/work_on_rays.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <string>

#include "core/parallel/parallel.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/gather.h"

namespace minkray {
namespace {

constexpr int most_threads = 1024;

/// Reports progress to the caller, from whichever thread has done a part while no other reports.
class Progress {
 public:
  Progress(const minkray_options* options, std::size_t count) : options_(options), count_(count) {}

  bool stopped() const { return stopped_.load(std::memory_order_relaxed); }

  void add(std::size_t more) {
    const std::size_t done = done_ += more;
    if (!options_ || !options_->progress) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || stopped()) return;
    if (wants_stop(options_, static_cast<double>(done) / static_cast<double>(count_)))
      stopped_ = true;
  }

 private:
  const minkray_options* options_;
  std::size_t count_;
  std::atomic<std::size_t> done_ = 0;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
};

}  // namespace

bool wants_stop(const minkray_options* options, double done) {
  if (!options || !options->progress) return false;
  try {
    return options->progress(options->user, done) != 0;
  } catch (const std::exception& error) {
    wrong_use(std::string("options.progress: must not throw (got \"") + error.what() + "\")");
  }
}

int checked_threads(int threads) {
  if (threads < 0 || threads > most_threads)
    wrong_use("options.threads: must be between 0 and 1024 (got " + std::to_string(threads) + ")");
  return threads;
}

int threads_of(const minkray_options* options) {
  if (!options) return 0;
  if (options->size < sizeof(minkray_options))
    wrong_use("options.size: must be sizeof(minkray_options)");
  return checked_threads(options->threads);
}

void work_on_rays(std::size_t count, const minkray_options* options,
                  const std::function<void(std::size_t begin, std::size_t end)>& body) {
  work_on_parts(count, rays_a_part, options, body);
}

void work_on_parts(std::size_t count, std::size_t part_size, const minkray_options* options,
                   const std::function<void(std::size_t begin, std::size_t end)>& body) {
  const int threads = threads_of(options);
  Progress progress(options, count);
  const auto part = [&](std::size_t begin, std::size_t end) {
    if (progress.stopped()) return;
    body(begin, end);
    progress.add(end - begin);
  };
  const std::size_t parts = (count + part_size - 1) / part_size;
  const auto some_parts = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      part(i * part_size, std::min((i + 1) * part_size, count));
  };
  // One thread is the caller's own.
  if (threads == 1 || parts <= 1)
    some_parts(0, parts);
  else
    with_threads(threads, [&] { parallel_for(parts, 1, some_parts); });
  if (progress.stopped()) throw CallError(MINKRAY_STOPPED, "stopped by the caller");
}

void work_on_groups(std::size_t count, std::size_t group, bool gathered,
                    const minkray_options* options,
                    const std::function<void(std::size_t begin, std::size_t end)>& body) {
  Gathering gathering;
  work_on_rays(count, options, [&](std::size_t begin, std::size_t end) {
    const auto one = [&](std::size_t i) {
      const std::size_t first = begin + i * group;
      body(first, std::min(first + group, end));
    };
    const std::size_t groups = (end - begin + group - 1) / group;
    if (gathered)
      gathering.run(groups, one);
    else
      for (std::size_t i = 0; i < groups; ++i) one(i);
  });
}

}  // namespace minkray
