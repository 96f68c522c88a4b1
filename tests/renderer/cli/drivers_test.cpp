// SPDX-License-Identifier: MIT
// Pictures that several processes share, on one machine: GNU parallel, and Slurm's array jobs with
// a substitute for sbatch.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/renderer/cli/drivers.h"
#include "tests/support/expect_exit.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

/// In a shell's notation, the name of a picture with characters that are special to shells, to
/// printf and to sbatch.
constexpr const char* strange_name = R"('it'\''s "100%A", %d $HOME	a\b&ö;.pfm')";

TEST_F(Drivers, gnu_parallel) {
  if (!has_program("parallel")) GTEST_SKIP() << "needs GNU parallel";
  expect_same_picture(shell("\"$DRIVERS/render-parallel\" scene.json a.pfm 5 -s 8"));
  // A tile fails: the job fails, and continues when it is run again.
  const ProgramOutcome failed = shell(
      "mkdir -p b.pfm.parts/2-of-3.exr; \"$DRIVERS/render-parallel\" scene.json b.pfm 3 -s 8");
  EXPECT_NE(failed.exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "b.pfm"));
  EXPECT_TRUE(fs::exists(folder_ / "b.pfm.parts/1-of-3.exr"));
  expect_exit(
      0,
      shell("rmdir b.pfm.parts/2-of-3.exr; \"$DRIVERS/render-parallel\" scene.json b.pfm 3 -s 8 && "
            "cmp a.pfm b.pfm"));
  EXPECT_FALSE(fs::exists(folder_ / "b.pfm.parts"));
  // Files that do not belong to the picture stay.
  const ProgramOutcome noted = shell(
      "mkdir b.pfm.parts; cd b.pfm.parts; echo x > notes.txt; touch .1-of-3.exr.7.0123abcd.tmp; "
      "cd ..; \"$DRIVERS/render-parallel\" scene.json b.pfm 3 -s 8 && ls -A b.pfm.parts");
  EXPECT_EQ(noted.exit_code, 0) << noted.err;
  EXPECT_EQ(noted.out, "notes.txt\n");
  EXPECT_TRUE(has(noted.err, "note: b.pfm.parts is not removed"));
  expect_exit(
      0, shell(std::string("name=") + strange_name +
               "; name=\"{} {#} {.}\n$name\"; "
               "\"$DRIVERS/render-parallel\" scene.json \"$name\" 3 -s 8 && cmp a.pfm \"$name\" && "
               "! test -e \"$name.parts\""));
}

TEST_F(Drivers, numbers_of_tiles_are_whole_numbers) {
  for (const std::string driver : {"parallel", "slurm"})
    for (const std::string count : {"0", "-1", "1.5", "08", "many", "''"}) {
      const ProgramOutcome outcome =
          shell("\"$DRIVERS/render-" + driver + "\" scene.json a.pfm " + count);
      EXPECT_EQ(outcome.exit_code, 2) << driver << count;
      EXPECT_TRUE(has(outcome.err, "N must be a whole number >= 1"));
    }
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
}

TEST_F(Drivers, what_a_driver_needs_is_named_if_it_is_missing) {
  // A PATH with what the scripts call until then, and no more.
  expect_exit(0, shell("mkdir bin; for p in bash env; do ln -s \"$(command -v $p)\" bin/; done"));
  for (const auto& [driver, program] :
       {std::pair{"render-parallel", "GNU parallel"}, std::pair{"render-slurm", "sbatch"}}) {
    const ProgramOutcome outcome =
        shell("PATH=\"$PWD/bin\" \"$DRIVERS/\"" + std::string(driver) + " scene.json a.pfm 3");
    EXPECT_EQ(outcome.exit_code, 2) << driver;
    expect_parts(outcome.err, {std::string(driver) + ": needs", program});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.pfm.parts")) << driver;
  }
}

// A substitute for Slurm: runs each task as in sbatch's manual, with the array's variables and
// logs, one after the other, and rejects unknown options, arrays that are too large, unknown
// patterns in a log's name, jobs after the $LAST_JOB-th, and jobs that depend on unknown ones.
// Counts jobs from 17.
TEST_F(Drivers, slurm_array) {
  std::ofstream(folder_ / "sbatch") << R"sh(#!/usr/bin/env bash
echo job >> jobs
job=$((16 + $(wc -l < jobs)))
((job - 16 <= ${LAST_JOB:-1000})) || { echo "sbatch: too many jobs" >&2; exit 1; }
for word in "$@"; do
  case "$word" in
    --array=1-*) tasks="${word#--array=1-}" ;;
    --wrap=*) script="${word#--wrap=}" ;;
    --output=*) log="${word#--output=}" ;;
    --dependency=afterok:"$(seq -s: 17 $((job - 1)))") ;;
    --parsable | --requeue | --signal=B:TERM@60 | --cpus-per-task=* | --job-name=*) ;;
    *) echo "sbatch: $word" >&2; exit 1 ;;
  esac
done
[ "${tasks:-1}" -le "${MOST_TASKS:-1000}" ] || { echo "sbatch: too many tasks" >&2; exit 1; }
for task in $(seq 1 "${tasks:-1}"); do
  [ -z "$tasks" ] || export SLURM_ARRAY_TASK_ID=$task
  to="${log//%%/$'\n'}"
  to="${to//%A/$job}"
  to="${to//%a/$task}"
  case "$to" in *%*) echo "sbatch: --output=$log" >&2; exit 1 ;; esac
  sh -c "$script" > "${to//$'\n'/%}" 2>&1 || exit 1
done
echo "$job;cluster"
)sh";
  const std::string prepare = "chmod +x sbatch scontrol; PATH=\"$PWD:$PATH\"; rm -f jobs; ";
  std::ofstream(folder_ / "scontrol") << "#!/bin/sh\nexit 1\n";
  expect_same_picture(shell(prepare + "\"$DRIVERS/render-slurm\" scene.json a.pfm 4 -s 8"));
  // Five tiles where an array has two tasks at most: three arrays, and the job that merges.
  std::ofstream(folder_ / "scontrol")
      << "#!/bin/sh\necho 'MaxArraySize            = 3'\necho 'MaxJobCount = 10000'\n";
  const ProgramOutcome split =
      shell(prepare +
            "export MOST_TASKS=2; mkdir 'b%.pfm.parts'; echo x > 'b%.pfm.parts/notes.txt'; "
            "\"$DRIVERS/render-slurm\" scene.json 'b%.pfm' 5 -s 8 && cmp a.pfm 'b%.pfm' && "
            "wc -l < jobs && ls -A 'b%.pfm.parts' && cat 'b%.pfm.log'");
  EXPECT_EQ(split.exit_code, 0) << split.err;
  EXPECT_TRUE(has(split.out, "4\nnotes.txt\nnote: b%.pfm.parts is not removed"));
  expect_exit(
      0, shell(prepare + "name=" + strange_name +
               "; \"$DRIVERS/render-slurm\" scene.json \"$name\" 3 -s 8 && cmp a.pfm \"$name\" && "
               "! test -e \"$name.parts\" && test -e \"$name.log\""));
  // The third array is refused: the first two are named, for nothing will merge their tiles.
  expect_exit(
      1, shell(prepare + "export LAST_JOB=2; \"$DRIVERS/render-slurm\" scene.json c.pfm 5 -s 8"),
      {"no job will merge", "scancel 17 18\n"});
}

}  // namespace
}  // namespace minkray
