// SPDX-License-Identifier: MIT
// Frames as the program's users make them.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

class Frames : public ::testing::Test {
 protected:
  Frames() {
    std::ofstream(folder_ / "scene.json") << R"({
      "version": 1,
      "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0], "resolution": [48, 32],
                 "shutter": 0.05},
      "lights": [{"type": "environment", "zenith": [1, 1, 1], "nadir": [1, 1, 1]}],
      "materials": [{"name": "matt", "type": "lambert", "color": [0.7, 0.2, 0.2]}],
      "objects": [{"name": "ball", "shape": {"type": "sphere", "radius": 0.5}, "material": "matt",
                   "keys": [{"time": 0, "translate": [-1, 0, 0]},
                            {"time": 1, "translate": [1, 0, 0]}]}]})";
  }

  ProgramOutcome render(const std::string& arguments) const {
    return run_minkray(folder_, "render scene.json -s 2 -q " + arguments);
  }
  std::vector<std::string> pictures() const {
    std::vector<std::string> names;
    for (const std::string& name : folder_.files())
      if (!name.ends_with(".json")) names.push_back(name);
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(Frames, each_into_a_file_of_its_number_and_all_onto_the_contact_sheet) {
  expect_exit(0, render("--frames 9..11 --rate 10 -o 'f-###.png' --contact-sheet sheet.png"));
  EXPECT_EQ(pictures(), (std::vector<std::string>{"f-###.png.frames", "f-009.png", "f-010.png",
                                                  "f-011.png", "sheet.png"}));
  EXPECT_NE(text_of_file(folder_ / "f-009.png"), text_of_file(folder_ / "f-010.png"));
}

TEST_F(Frames, a_frame_is_the_same_alone_and_in_a_sequence) {
  expect_exit(0, render("--frames 0..2 --rate 4 -o 'a#.pfm'"));
  expect_exit(0, render("--frames 2..2 --rate 4 -o 'b#.pfm'"));
  EXPECT_TRUE(text_of_file(folder_ / "a2.pfm") == text_of_file(folder_ / "b2.pfm"));
  // Frame 0 is what the scene shows without frames.
  expect_exit(0, render("-o still.pfm"));
  EXPECT_TRUE(text_of_file(folder_ / "a0.pfm") == text_of_file(folder_ / "still.pfm"));
}

TEST_F(Frames, resume_renders_those_that_are_not_there) {
  expect_exit(0, render("--frames 0..2 -o 'f#.png'"));
  const std::string first = text_of_file(folder_ / "f1.png");
  std::ofstream(folder_ / "f0.png") << "kept";
  std::filesystem::remove(folder_ / "f1.png");
  expect_exit(0, render("--frames 0..3 -o 'f#.png' --resume"));
  EXPECT_EQ(text_of_file(folder_ / "f0.png"), "kept");
  EXPECT_EQ(text_of_file(folder_ / "f1.png"), first);
  EXPECT_EQ(pictures(),
            (std::vector<std::string>{"f#.png.frames", "f0.png", "f1.png", "f2.png", "f3.png"}));
}

// Until now whatever had a frame's name was taken for it.
TEST_F(Frames, of_which_no_record_tells_are_rendered_again) {
  std::ofstream(folder_ / "f0.png") << "whose?";
  expect_exit(0, render("--frames 0..1 -o 'f#.png' --resume"));
  EXPECT_EQ(text_of_file(folder_ / "f0.png").substr(1, 3), "PNG");
  // Another output has a record of its own.
  std::ofstream(folder_ / "f1.pfm") << "whose?";
  expect_exit(0, render("--frames 0..1 -o 'f#.png' -o 'f#.pfm' --resume"));
  EXPECT_EQ(text_of_file(folder_ / "f1.pfm").substr(0, 2), "PF");
}

TEST_F(Frames, of_another_animation_are_refused_with_what_differs) {
  expect_exit(0, render("--frames 0..1 -o 'f#.png'"));
  const std::string before = text_of_file(folder_ / "f#.png.frames");
  for (const auto& [options, difference] : std::vector<std::pair<std::string, std::string>>{
           {"-r 24x16", "minkray.resolution is 48x32, not 24x16"},
           {"--seed 3", "minkray.seed is 0, not 3"},
           {"--rate 25", "minkray.rate is 24.0, not 25.0"},
           {"--exposure 0.5", "minkray.exposure is 0.0, not 0.5"},
           {"--crop 0,0,9,9", "minkray.crop is 0,0,48,32, not 0,0,9,9"},
           {"--solver paper", "minkray.solver is auto, not paper"}}) {
    const ProgramOutcome other = render("--frames 0..2 -o 'f#.png' --resume " + options);
    EXPECT_EQ(other.exit_code, 3) << options;
    expect_parts(other.err, {"f#.png.frames: is the record of other frames: " + difference,
                             "; remove it, or render without --resume\n"});
  }
  EXPECT_EQ(text_of_file(folder_ / "f#.png.frames"), before);
  EXPECT_EQ(pictures(), (std::vector<std::string>{"f#.png.frames", "f0.png", "f1.png"}));
  expect_exit(0, render("--frames 0..1 -o 'f#.png' --seed 3"));
  expect_exit(0, render("--frames 0..1 -o 'f#.png' --seed 3 --resume"));
}

TEST_F(Frames, a_file_that_is_no_record_stays) {
  std::ofstream(folder_ / "f#.png.frames") << "notes";
  expect_exit(4, render("--frames 0..1 -o 'f#.png'"));
  expect_exit(3, render("--frames 0..1 -o 'f#.png' --resume"));
  EXPECT_EQ(text_of_file(folder_ / "f#.png.frames"), "notes");
  EXPECT_EQ(pictures(), std::vector<std::string>{"f#.png.frames"});
}

TEST_F(Frames, wrong_usage_is_told_and_leaves_nothing) {
  const auto tells = [&](const std::string& arguments, const std::string& what) {
    const ProgramOutcome outcome = render(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_TRUE(has(outcome.err, what)) << arguments;
  };
  tells("--frames 9..3 -o 'f#.png'",
        "--frames: the first frame must not be after the last (got 9..3)");
  tells("--frames 3 -o 'f#.png'",
        "--frames: must be the first and the last frame, as in 0..24 (got 3)");
  tells("--frames=-1..3 -o 'f#.png'", "--frames: frames go from 0 to 1000000 (got -1..3)");
  tells("--frames 1..x -o 'f#.png'", "--frames: must be the first and the last frame");
  tells("--frames 0..1 -o f.png", "must have one run of # for the frame's number");
  tells("--frames 0..1 -o 'f#-#.png'", "must have one run of # for the frame's number");
  tells("--frames 0..1 -o 'f#.exr' --tile 1/2", "--frames: not allowed with --tile");
  tells("--frames 0..1 -o 'f#.png' --certify", "--frames: not allowed with --certify");
  tells("-o f.png --contact-sheet s.png", "--contact-sheet: requires --frames");
  tells("--frames 0..1 -o 'f#.png' --contact-sheet s.png --resume", "not allowed with --resume");
  tells("--frames 0..1 -o 'f#.png' --contact-sheet s.txt", "s.txt");
  EXPECT_TRUE(pictures().empty());
}

}  // namespace
}  // namespace minkray
