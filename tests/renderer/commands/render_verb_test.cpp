// SPDX-License-Identifier: MIT
// The program as its users meet it: exit codes, and what is left on the disk.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

constexpr const char* scene_text = R"({
  "version": 1,
  "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0], "up": [0, 0, 1], "fov_y_degrees": 40,
             "resolution": [64, 48]},
  "lights": [{"type": "environment", "zenith": [1, 1, 1], "nadir": [1, 1, 1]}],
  "materials": [{"name": "matt", "type": "lambert", "color": [0.7, 0.7, 0.7]}],
  "objects": [{"name": "ball", "shape": {"type": "sphere", "radius": 1}, "material": "matt"}]
})";

class RenderVerb : public ::testing::Test {
 protected:
  RenderVerb() { folder_.write("scene.json", scene_text); }

  std::string path(const std::string& file) const { return folder_ / file; }
  std::vector<std::string> files() const { return folder_.files(); }
  static int exit_code(const std::vector<std::string>& arguments) {
    const int status = wait_for(start_minkray(arguments));
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  TemporaryFolder folder_;
};

TEST_F(RenderVerb, writes_every_output) {
  EXPECT_EQ(exit_code({"render", path("scene.json"), "-o", path("a.png"), "-o", path("a.pfm"), "-s",
                       "2", "--stats=json"}),
            0);
  EXPECT_EQ(text_of_file(path("a.png")).substr(1, 3), "PNG");
  EXPECT_EQ(text_of_file(path("a.pfm")).substr(0, 9), "PF\n64 48\n");
  EXPECT_EQ(exit_code({"heatmap", path("scene.json"), "-o", path("h.png"), "--side-by-side",
                       "paper,auto"}),
            0);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.pfm", "a.png", "h.png", "scene.json"}));
}

TEST_F(RenderVerb, a_crop_of_a_huge_picture_is_no_huge_picture) {
  EXPECT_EQ(exit_code({"render", path("scene.json"), "-o", path("a.pfm"), "-s", "1", "-r",
                       "65536x65536", "--crop", "30000,30000,30010,30005"}),
            0);
  EXPECT_EQ(text_of_file(path("a.pfm")).substr(0, 8), "PF\n10 5\n");
}

TEST_F(RenderVerb, wrong_values_are_wrong_usage) {
  const std::vector<std::vector<std::string>> wrong = {{"-s", "0"},
                                                       {"-s", "-1"},
                                                       {"-s", "many"},
                                                       {"-r", "0x0"},
                                                       {"-r", "64"},
                                                       {"-r", "64x48x2"},
                                                       {"-r", "100000x100000"},
                                                       {"-r", "20000x20000"},
                                                       {"-r", "64x-48"},
                                                       {"-r", "64 x48"},
                                                       {"-t", "-1"},
                                                       {"-t", "1.5"},
                                                       {"--crop", "0,0,65,48"},
                                                       {"--crop", "1,2"},
                                                       {"--crop", "9,9,9,20"},
                                                       {"--crop", "-1,0,5,5"},
                                                       {"--solver", "magic"},
                                                       {"--exposure", "nan"},
                                                       {"--exposure", "inf"},
                                                       {"--stats=xml"},
                                                       {"--seed", "-3"},
                                                       {"-o", path("a.jpg")},
                                                       {"-q", "-v"},
                                                       {"--bounces", "-1"},
                                                       {"--unheard-of"}};
  for (const auto& values : wrong) {
    std::vector<std::string> arguments = {"render", path("scene.json"), "-o", path("a.png")};
    arguments.insert(arguments.end(), values.begin(), values.end());
    EXPECT_EQ(exit_code(arguments), 2) << values.front() << " " << values.back();
  }
  EXPECT_EQ(exit_code({"heatmap", path("scene.json"), "-o", path("a.png"), "--channel", "x"}), 2);
  EXPECT_EQ(exit_code({"heatmap", path("scene.json"), "-o", path("a.png"), "--side-by-side",
                       "paper,magic"}),
            2);
  EXPECT_EQ(files(), std::vector<std::string>{"scene.json"});
}

TEST_F(RenderVerb, files_that_cannot_be_read_or_written) {
  EXPECT_EQ(exit_code({"render", path("none.json"), "-o", path("a.png")}), 3);
  EXPECT_EQ(exit_code({"render", path("scene.json"), "-o", path("none/a.png")}), 4);
  fs::create_directory(path("b.png"));
  EXPECT_EQ(exit_code({"render", path("scene.json"), "-o", path("b.png")}), 4);
}

// Whenever the signal comes, the picture that was there before is there still, or a whole new one.
TEST_F(RenderVerb, an_interrupted_render_costs_nothing) {
  const std::string target = path("a.png");
  ASSERT_EQ(exit_code({"render", path("scene.json"), "-o", target, "-s", "1"}), 0);
  const std::string before = text_of_file(target);
  int ended_by_signal = 0;
  for (int i = 0; i < 16; ++i) {
    const int signal = i % 2 ? SIGINT : SIGTERM;
    const pid_t child = start_minkray({"render", path("scene.json"), "-o", target, "-s", "100000"});
    std::this_thread::sleep_for(std::chrono::milliseconds(1 + 6 * i));
    ::kill(child, signal);
    const int status = wait_for(child);
    EXPECT_FALSE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    if (WIFSIGNALED(status) && WTERMSIG(status) == signal) ++ended_by_signal;
    EXPECT_EQ(text_of_file(target), before);
    EXPECT_EQ(files(), (std::vector<std::string>{"a.png", "scene.json"})) << i;
  }
  EXPECT_EQ(ended_by_signal, 16);
}

}  // namespace
}  // namespace minkray
