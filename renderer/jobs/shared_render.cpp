// SPDX-License-Identifier: MIT
#include "renderer/jobs/shared_render.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>

#include "core/parallel/parallel.h"
#include "renderer/base/errors.h"
#include "renderer/base/interrupt.h"
#include "renderer/io/output_file.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

/// Messages: rank 0 sends `begin` when all is ready, other ranks then request tiles, and rank 0
/// returns a tile's number, from 1, or `no_more_tiles`.
constexpr int begin = -1;
constexpr int give_me_a_tile = 0;
constexpr int no_more_tiles = 0;

/// Interval between checks for messages. Waiting within MPI would keep a core busy and delay
/// signals.
constexpr auto pause = std::chrono::milliseconds(1);

/// Hands out the numbers 1 to count, each once.
class TileQueue {
 public:
  explicit TileQueue(int count) : count_(count) {}
  int next() {
    const std::lock_guard lock(mutex_);
    return given_ < count_ ? ++given_ : no_more_tiles;
  }

 private:
  std::mutex mutex_;
  const int count_;
  int given_ = 0;
};

/// Waits for the message of rank 0. Ends the process if it is interrupted.
int answer_of_rank_0(Ranks& ranks) {
  for (;;) {
    if (const auto message = ranks.poll()) return message->number;
    InterruptGuard::end_if_interrupted();
    std::this_thread::sleep_for(pause);
  }
}

/// Answers the other ranks until each has received `no_more_tiles`, or a stop is requested.
void hand_out(const std::stop_token& stop, Ranks& ranks, TileQueue& queue) {
  int at_work = ranks.count() - 1;
  while (at_work > 0 && !stop.stop_requested() && !InterruptGuard::interrupted()) {
    const auto request = ranks.poll();
    if (!request) {
      std::this_thread::sleep_for(pause);
      continue;
    }
    const int tile = queue.next();
    ranks.send(request->from, tile);
    if (tile == no_more_tiles) --at_work;
  }
}

std::string six_digits(int number) {
  std::array<char, 16> text;
  std::snprintf(text.data(), text.size(), "%06d", number);
  return text.data();
}

std::string part_file(const std::string& output, int tile, int tiles) {
  const std::string name = six_digits(tile) + "-of-" + six_digits(tiles) + ".exr";
  return (fs::path(parts_folder(output)) / name).string();
}

void tell_threads(const Ranks& ranks) {
  std::array<char, 256> host = {};
  ::gethostname(host.data(), host.size() - 1);
  const std::string rank =
      "rank " + std::to_string(ranks.rank()) + " of " + std::to_string(ranks.count());
  std::string text = rank + " on " + host.data() + ": " + std::to_string(thread_count()) +
                     (thread_count() == 1 ? " thread\n" : " threads\n");
  cpu_set_t cores;
  CPU_ZERO(&cores);
  const long online = ::sysconf(_SC_NPROCESSORS_ONLN);
  if (::sched_getaffinity(0, sizeof cores, &cores) == 0 && CPU_COUNT(&cores) == 1 && online > 1)
    text += "warning: " + rank + " is pinned to one of " + std::to_string(online) +
            " cores: give mpirun --bind-to none, or --map-by slot:PE=n for n cores a rank\n";
  std::cerr << text;  // in one call, so that the ranks' lines do not mix
}

/// Removes leading characters of a kind from a text, at most `most`.
template <class IsOfKind>
std::size_t skip(std::string_view& text, IsOfKind&& is_of_kind,
                 std::size_t most = std::string::npos) {
  std::size_t count = 0;
  while (count < std::min(most, text.size()) && is_of_kind(text[count])) ++count;
  text.remove_prefix(count);
  return count;
}

/// Removes a word from the beginning of a text, if it is there.
bool skip_word(std::string_view& text, std::string_view word) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

/// True if a file is a tile of a picture with this many tiles, a checkpoint of a tile, or a
/// temporary file of either. Killed ranks leave such files.
/// 000007-of-000024.exr,
/// .000007-of-000024.exr.checkpoint.1234.0123abcd.tmp
bool is_of_part_file(std::string_view name, int tiles) {
  const auto is_digit = [](char c) { return '0' <= c && c <= '9'; };
  const auto is_hex_digit = [&](char c) { return is_digit(c) || ('a' <= c && c <= 'f'); };
  skip_word(name, ".");
  if (skip(name, is_digit, 6) != 6 || !skip_word(name, "-of-" + six_digits(tiles) + ".exr"))
    return false;
  skip_word(name, ".checkpoint");
  if (name.empty()) return true;
  return skip_word(name, ".") && skip(name, is_digit) > 0 && skip_word(name, ".") &&
         skip(name, is_hex_digit, 8) == 8 && name == ".tmp";
}

}  // namespace

std::string parts_folder(const std::string& output) {
  return output + ".parts";
}

int default_tile_count(const PixelRect& picture) {
  constexpr std::int64_t pixels_a_tile = 4096;
  const std::int64_t pixels = std::int64_t{picture.width()} * picture.height();
  return static_cast<int>(std::clamp<std::int64_t>(pixels / pixels_a_tile, 1, 9999));
}

std::optional<Merged> render_on(Ranks& ranks, const RenderJob& job, int tiles,
                                const std::string& output) {
  tell_threads(ranks);
  if (ranks.rank() == 0) {
    std::error_code error;
    fs::create_directory(parts_folder(output), error);
    if (error) throw CannotWrite("cannot write " + parts_folder(output) + ": " + error.message());
    for (int other = 1; other < ranks.count(); ++other) ranks.send(other, begin);
  } else if (answer_of_rank_0(ranks) != begin) {
    return std::nullopt;
  }

  RenderJob tile_job = job;
  tile_job.quiet = true;
  const auto render_tile = [&](int tile) {
    tile_job.options.tile = {tile, tiles};
    const std::string file = part_file(output, tile, tiles);
    if (job.resume && is_part_file_of(file, facts_of(tile_job))) return;
    Checkpoint checkpoint = checkpoint_of(tile_job, file);
    write_file(file, encode_exr(run(tile_job, checkpoint).exr));
    checkpoint.remove();
    InterruptGuard::end_if_interrupted();
  };

  if (ranks.rank() != 0) {
    for (;;) {
      ranks.send(0, give_me_a_tile);
      const int tile = answer_of_rank_0(ranks);
      if (tile == no_more_tiles) return std::nullopt;
      render_tile(tile);
    }
  }
  TileQueue queue(tiles);
  {
    // Declared after the variables that it uses, so that it is joined before they end, even if a
    // tile fails here.
    std::jthread others([&](const std::stop_token& stop) { hand_out(stop, ranks, queue); });
    while (const int tile = queue.next()) {
      render_tile(tile);
      if (!job.quiet && ::isatty(STDERR_FILENO) == 1)
        std::cerr << "\rtile " << tile << " of " << tiles << std::flush;
    }
    others.join();
  }
  InterruptGuard::end_if_interrupted();
  std::vector<std::string> files;
  for (int tile = 1; tile <= tiles; ++tile) files.push_back(part_file(output, tile, tiles));
  return merge_part_files(files, false);
}

void remove_parts(const std::string& output, int tiles) {
  const std::string folder = parts_folder(output);
  std::error_code error, ignored;
  std::vector<fs::path> files;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->is_regular_file(ignored) && is_of_part_file(at->path().filename().string(), tiles))
      files.push_back(at->path());
  // Keeps the first error, which explains why the folder stays; later ones follow from it.
  for (const fs::path& file : files) fs::remove(file, error ? ignored : error);
  if (fs::remove(folder, ignored); !ignored) return;
  if (!error) error = ignored;
  const std::string why = error == std::errc::directory_not_empty
                              ? ": it contains more than this picture's tiles"
                              : ": " + error.message();
  std::cerr << "note: " + printable(folder) + " is not removed" + printable(why) + "\n";
}

}  // namespace minkray
