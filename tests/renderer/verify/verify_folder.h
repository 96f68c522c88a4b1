// SPDX-License-Identifier: MIT
// A folder for the tests of minkray verify, and the checker of its proofs.
#pragma once

#include <gtest/gtest.h>

#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"

namespace minkray {

class VerifyFolder : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  ProgramOutcome verify(const std::string& words) const {
    return run_minkray(folder_, "verify " + words);
  }
  static std::string checker() { return (source_folder() / "tools/minkray-check").string(); }
  ProgramOutcome check(const std::string& words, const std::string& before = "") const {
    return run_in(folder_, before + python() + " '" + checker() + "' " + words);
  }
  /// Python with NumPy; empty if there is none.
  static std::string python() {
    static const std::string found = [] {
      for (const std::string one : {"python3", "/usr/bin/python3"})
        if (run_shell(one + " -c 'import numpy'").exit_code == 0) return one;
      return std::string();
    }();
    return found;
  }

  TemporaryFolder folder_;
};

}  // namespace minkray
