// SPDX-License-Identifier: MIT
// Renders, scans and queries for a time with several threads in one process, with edits, cancelled
// calls and errors in between. Each round must give the bits of the first one, and resources must
// not grow. Exit codes: 0 held, 1 not, 2 usage.
//   minkray_soak SECONDS [leak|answer]   leak: leaks 16 KiB per round, which must be found;
//                                        answer: a wrong result in the last round, likewise
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "tests/renderer/library/shapes.h"
#include "tests/soak/memory.h"
#include "tests/soak/work.h"

namespace soak {
namespace {

constexpr int workers = 4;        // that do work at once
constexpr int states = 3;         // of a round's scene
constexpr std::size_t least = 8;  // rounds, however little time there is
constexpr std::size_t kind_count = std::size(kinds);

struct Tally {
  std::uint64_t first[states][kind_count] = {};  ///< the first round's hashes
  std::atomic<long> wrong = 0, stopped = 0;
  std::mutex printing;
};

/// All kinds of work, by several threads; the combination that runs together differs from round to
/// round.
void all_kinds(const mk::Scene& scene, std::size_t round, int state, bool lie, Tally& tally) {
  std::atomic<std::size_t> next = 0;
  const Common common = {scene, static_cast<int>(round % 3) + 1, tally.stopped};
  const auto take = [&] {
    for (std::size_t i = next++; i < kind_count; i = next++) {
      const std::size_t kind = (i * 7 + round) % kind_count;  // 7 and 15 have no common divisor
      std::string complaint;
      try {
        Answers answers;
        kinds[kind].work(common, answers);
        if (lie && kind == 0) answers.add(0);
        if (round == 0)
          tally.first[state][kind] = answers.hash();
        else if (answers.hash() != tally.first[state][kind])
          complaint = "other answers than in the first round";
      } catch (const std::exception& error) {
        complaint = error.what();
      }
      if (complaint.empty()) continue;
      ++tally.wrong;
      const std::lock_guard lock(tally.printing);
      std::printf("round %zu, state %d, %s: %s\n", round, state, kinds[kind].name,
                  complaint.c_str());
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < workers; ++i) threads.emplace_back(take);
  for (std::thread& thread : threads) thread.join();
}

/// A scene from its making to its end: built, refitted after moves, rebuilt with more objects.
void one_round(std::size_t round, bool lie, Tally& tally) {
  static_assert(kind_count % 7 != 0);
  mk::Scene scene = scene_of_shapes();
  all_kinds(scene, round, 0, lie, tally);
  for (std::uint32_t i = 0; i < 19; i += 3)
    scene.set_pose(i, mk::pose({0.2, 0.1, 0.3}, {0, 0.1, 0.2, 1}) * scene.pose(i));
  scene.commit();
  all_kinds(scene, round, 1, false, tally);
  for (int i = 0; i < 30; ++i)
    scene.add(mk::rounded(mk::box({0.1, 0.05, 0.08}), 0.02),
              mk::pose({-2 + 0.13 * i, -1 + 0.05 * i, 1.5}, {0.1 * i, 0.2, 0.3, 1}));
  scene.commit();
  all_kinds(scene, round, 2, false, tally);
}

void print(const Held& held, std::size_t round) {
  std::printf(
      "%7.0f s  %6zu rounds  %8.2f MiB resident  %9.1f KiB in use  %2zu files  %2zu threads\n",
      held.seconds, round, static_cast<double>(held.resident) / 1048576,
      static_cast<double>(held.in_use) / 1024, held.files, held.threads);
  std::fflush(stdout);
}

int run(double seconds, const std::string& fault) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const auto since = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  Tally tally;
  std::vector<Held> rounds;
  // Else the list itself would grow: a round takes far more than a hundredth of a second.
  rounds.reserve(least + static_cast<std::size_t>(100 * seconds));
  std::vector<std::vector<char>> lost;
  int lines = 0;
  while (rounds.size() < least || since() < seconds) {
    const std::size_t round = rounds.size();
    one_round(round, fault == "answer" && round + 1 >= least, tally);
    if (fault == "leak") lost.emplace_back(16384);
    rounds.push_back(held_now(since()));
    const bool is_due = since() >= seconds / 10 * (lines + 1) || round == 0;
    if (is_due) print(rounds.back(), rounds.size());
    if (is_due && round > 0) ++lines;
  }
  print(rounds.back(), rounds.size());
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  const std::string grew;  // the sanitizer has an allocator of its own, and looks for leaks itself
#else
  const std::string grew = what_grew(rounds);
#endif
  const long calls = static_cast<long>(rounds.size()) * states * static_cast<long>(kind_count);
  std::printf(
      "soak process: %s: %zu rounds in %.0f s, %ld pieces of work by %d threads, %ld of them"
      " with other answers or errors, %ld calls cancelled; memory %s\n",
      tally.wrong == 0 && grew.empty() ? "held" : "FAILED", rounds.size(), since(), calls, workers,
      tally.wrong.load(), tally.stopped.load(), grew.empty() ? "flat" : ("grew: " + grew).c_str());
  return tally.wrong == 0 && grew.empty() ? 0 : 1;
}

}  // namespace
}  // namespace soak

int main(int count, char** words) {
  char* end = nullptr;
  const double seconds = count > 1 ? std::strtod(words[1], &end) : -1;
  const std::string fault = count > 2 ? words[2] : "";
  const bool is_known = fault.empty() || fault == "leak" || fault == "answer";
  if (count > 3 || !end || *end != '\0' || !(seconds >= 0 && seconds <= 1e6) || !is_known) {
    std::fputs("usage: minkray_soak SECONDS [leak|answer]\n", stderr);
    return 2;
  }
  return soak::run(seconds, fault);
}
