// SPDX-License-Identifier: MIT
// Concurrent renders of frames keep one record, and lose none of each other's frames.
#include "renderer/share/frames_record.h"

#include <gtest/gtest.h>

#include <barrier>
#include <thread>
#include <vector>

#include "tests/support/program.h"

namespace minkray {
namespace {

TEST(FramesRecord, several_that_write_it_at_once_lose_no_frame) {
  constexpr int writers = 4, frames = 15;
  const TemporaryFolder folder;
  const std::string path = FramesRecord::path_for(folder / "frame-#.png");
  const Facts facts = {{fact::software, "test"}, {fact::rate, "24"}};
  std::barrier together(writers);
  std::vector<std::thread> threads;
  for (int writer = 0; writer < writers; ++writer)
    threads.emplace_back([&, writer] {
      FramesRecord record(path, facts, true);
      for (int k = 0; k < frames; ++k) {
        together.arrive_and_wait();
        record.add(k * writers + writer);
        // The file must not be restored from this one's memory.
        record = FramesRecord(path, facts, true);
      }
    });
  for (std::thread& thread : threads) thread.join();
  const FramesRecord whole(path, facts, true);
  for (int frame = 0; frame < writers * frames; ++frame) EXPECT_TRUE(whole.has(frame)) << frame;
}

}  // namespace
}  // namespace minkray
