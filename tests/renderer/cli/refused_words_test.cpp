// SPDX-License-Identifier: MIT
// Command lines that cannot be meant: wrong usage, and nothing is written over.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/renderer/cli/nothing_lost.h"
#include "tests/support/expect_exit.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

TEST_F(NothingLost, values_that_do_not_fit_are_wrong_usage) {
  for (const std::string arguments : {"render scene.json -o a.png --seed 18446744073709551616",
                                      "render scene.json -o a.png --seed 99999999999999999999999",
                                      "render scene.json -o a.png --seed 1.5",
                                      "heatmap scene.json -o a.png --side-by-side ''",
                                      "render scene.json -o a.png --aov Z",
                                      "render scene.json -o a.exr --aov depth",
                                      "render scene.json -o a.exr --tile 3/2",
                                      "render scene.json -o a.png --tile 1/2",
                                      "render scene.json -o a.exr -r 2x2 --tile 1/5",
                                      "render scene.json -o a.exr -s 2 --sample-share 1/3",
                                      "render scene.json -o a.exr --sample-share 1/2 --aov Z",
                                      "render scene.json -o a.png --checkpoint -1",
                                      "render scene.json -o a.png --checkpoint nan",
                                      "heatmap scene.json -o a.png --side-by-side auto,fast",
                                      "render scene.json -o a.png --frames 0..1 --rate nan",
                                      "render scene.json -o a.png -o ./a.png",
                                      "generate spheres -o b.json --seed 18446744073709551616",
                                      "generate spheres -o b.f32",
                                      "trace scene.json --pixel 1,1 --svg scene.json",
                                      "distance-2d scene.json -o scene.json",
                                      "frobnicate",
                                      "merge -o a.png"}) {
    const ProgramOutcome outcome = minkray(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.err, "") << arguments;
  }
  expect_exit(4, minkray("trace scene.json --pixel 1,1 --svg ''"));
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
  expect_exit(0, minkray("render scene.json -o a.png -s 1 --seed 18446744073709551615"));
}

TEST_F(NothingLost, messages_about_values_have_one_form) {
  for (const auto& [arguments, message] :
       {std::pair{"-s many", "--spp: must be a number from 1 to 16777216 (got many)"},
        {"-s 0", "--spp: must be a number from 1 to 16777216 (got 0)"},
        {"-s", "--spp: must have a value (got none)"},
        {"-r 2x2 -r 3x3", "--resolution: must be given once (got 2)"}}) {
    const ProgramOutcome outcome =
        shell(std::string("\"$MINKRAY\" render scene.json -o a.png ") + arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err.substr(0, outcome.err.find('\n')), message);
  }
  EXPECT_TRUE(minkray("trace scene.json --pixel 1")
                  .err.starts_with("--pixel: must have at least 2 values (got 1)\n"));
  EXPECT_TRUE(minkray("distance scene.json scene.json --at-most far")
                  .err.starts_with("--at-most: must be a number (got far)\n"));
}

TEST_F(NothingLost, no_output_takes_the_place_of_an_input_or_another_output) {
  expect_exit(0, shell(R"(set -e
    fails() { expected=$1; shift; if "$MINKRAY" "$@"; then exit 1; else test $? = $expected; fi; }
    for i in 1 2; do "$MINKRAY" render scene.json -s 1 --tile $i/2 -o $i.exr; done
    cp 1.exr kept1.exr; cp 2.exr kept2.exr
    fails 2 merge 1.exr 2.exr -o 1.exr
    fails 2 merge 1.exr 2.exr -o ./2.exr
    cmp 1.exr kept1.exr; cmp 2.exr kept2.exr
    fails 2 render scene.json -s 1 -o 'f#.png' --frames 1..2 --contact-sheet ./f2.png
    fails 2 render scene.json -s 1 -o 'f#.png' --frames 0..1000000 --contact-sheet f1000000.png
    test ! -e f1.png
    echo notes > a.png.checkpoint
    fails 4 render scene.json -s 1 -o a.png
    "$MINKRAY" render scene.json -s 1 -o a.png --checkpoint 0
    grep -q notes a.png.checkpoint
    mkdir b.png.checkpoint
    fails 4 render scene.json -s 1 -o b.png
    test -d b.png.checkpoint)"),
              {"a.png.checkpoint: not a checkpoint"});
}

/// The textures and the sky of a scene were written over.
TEST_F(NothingLost, a_picture_takes_the_place_of_none_that_the_scene_shows) {
  expect_exit(0, shell(R"(set -e
    fails() { if "$MINKRAY" "$@"; then exit 1; else test $? = 2; fi; }
    "$MINKRAY" render scene.json -s 1 -r 8x8 -o sky1.png; cp sky1.png kept.png; ln -s sky1.png link.png
    printf '%s' '{"version": 1, "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0]},
      "lights": [{"type": "environment", "file": "sky1.png"}],
      "materials": [{"name": "m", "type": "lambert", "color": [1, 1, 1]}],
      "objects": [{"name": "o", "shape": {"type": "sphere", "radius": 1}, "material": "m"}]}' > lit.json
    fails render lit.json -s 1 -r 8x8 -o sky1.png
    fails render lit.json -s 1 -r 8x8 -o a.png -o link.png
    fails render lit.json -s 1 -r 8x8 -o 'sky#.png' --frames 0..2
    fails render lit.json -s 1 -r 8x8 -o 'f#.png' --frames 0..2 --contact-sheet ./sky1.png
    fails heatmap lit.json -r 8x8 -o sky1.png
    fails compare lit.json --rays 10 -r 8x8 -o sky1.png
    test ! -e a.png; test ! -e f0.png; test ! -e sky0.png; cmp sky1.png kept.png
    "$MINKRAY" render lit.json -s 1 -r 8x8 -o a.png -q)"),
              {"--output: sky1.png is read or written already, as"});
}

/// The CSV file of a lidar's pattern was gone, and so was the robot's path.
TEST_F(NothingLost, a_scan_takes_the_place_of_nothing_that_it_reads) {
  expect_exit(0, shell(R"(set -e
    fails() { if "$MINKRAY" "$@"; then exit 1; else test $? = 2; fi; }
    printf 'time,azimuth,zenith\n0,1,90\n' > pattern.csv; cp pattern.csv kept.csv
    fails scan scene.json --pattern pattern.csv -o pattern.csv
    fails scan scene.json --pattern pattern.csv -o ./a.ply -o a.ply
    fails scan scene.json --pattern spinning:2x4 -o a.csv --ids scene.json
    fails scan scene.json --pattern spinning:2x4 --path pattern.csv -o a.ply -o pattern.csv
    fails scan scene.json --pattern spinning:2x4 --joints pattern.csv -o pattern.csv
    test ! -e a.ply; cmp pattern.csv kept.csv
    "$MINKRAY" scan scene.json --pattern pattern.csv -o a.csv -o a.ply -q)"),
              {"--output: pattern.csv is read or written already"});
}

TEST_F(NothingLost, help_that_nobody_gets_is_no_success) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  expect_exit(4, minkray("--help > /dev/full"));
  expect_exit(4, minkray("render --help > /dev/full"));
  expect_exit(4, minkray("--version > /dev/full"));
}

}  // namespace
}  // namespace minkray
