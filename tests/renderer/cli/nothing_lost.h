// SPDX-License-Identifier: MIT
// The folder of the tests of faults from outside, with a small scene in it.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/support/program.h"

namespace minkray {

class NothingLost : public ::testing::Test {
 protected:
  NothingLost() { write_ball_scene(folder_ / "scene.json"); }

  std::string quoted(const std::string& name) const { return "'" + (folder_ / name) + "'"; }
  ProgramOutcome shell(const std::string& command) const { return run_in(folder_, command); }

  ProgramOutcome minkray(const std::string& words) const { return shell("\"$MINKRAY\" " + words); }

  /// True if it becomes true within a minute; tested a thousand times per second.
  template <class Condition>
  static bool wait_until(const Condition& is_true) {
    for (int i = 0; i < 60000; ++i) {
      if (is_true()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  /// The file's number; 0 if there is none.
  static ino_t inode_of(const std::string& file) {
    struct stat status = {};
    return ::stat(file.c_str(), &status) == 0 ? status.st_ino : 0;
  }
  /// The child remains to be waited for.
  static bool has_ended(pid_t child) {
    siginfo_t info = {};
    return ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid == child;
  }

  TemporaryFolder folder_;
};

}  // namespace minkray
