// SPDX-License-Identifier: MIT
// The ways to render a picture in several processes, for tests: a folder with a scene, and the
// picture that all ways must lead to.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {

class Drivers : public ::testing::Test {
 protected:
  Drivers() { write_ball_scene(folder_ / "scene.json"); }

  /// Runs in the folder, with the drivers' folder as $DRIVERS.
  ProgramOutcome shell(const std::string& command) const {
    return run_shell("cd '" + (folder_ / ".") + "'; DRIVERS='" +
                     (source_folder() / "renderer/drivers").string() +
                     "'; OMPI_ALLOW_RUN_AS_ROOT=1; OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; "
                     "export OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM\n" +
                     command);
  }
  ProgramOutcome minkray(const std::string& words) const { return shell("\"$MINKRAY\" " + words); }
  /// The picture that all ways must lead to.
  void expect_same_picture(const ProgramOutcome& outcome) const {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_EQ(minkray("render scene.json -s 8 -o whole.pfm").exit_code, 0);
    EXPECT_EQ(text_of_file(folder_ / "whole.pfm"), text_of_file(folder_ / "a.pfm"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.pfm.parts"));
  }

  TemporaryFolder folder_;
};

}  // namespace minkray
