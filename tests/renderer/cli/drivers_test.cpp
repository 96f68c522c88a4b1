// SPDX-License-Identifier: MIT
// Pictures that several processes share, on one machine: Open MPI, GNU parallel, and Slurm's array
// jobs with a stand-in for sbatch.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "renderer/ranks.h"
#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

class Drivers : public testing::Test {
 protected:
  Drivers() { write_ball_scene(folder_ / "scene.json"); }

  /// In the folder, with the drivers' folder as $DRIVERS.
  ProgramOutcome shell(const std::string& command) const {
    return run_shell("cd '" + (folder_ / ".") + "'; DRIVERS='" +
                     (source_folder() / "renderer/drivers").string() +
                     "'; OMPI_ALLOW_RUN_AS_ROOT=1; OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; "
                     "export OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM\n" +
                     command);
  }
  /// The picture that all ways must lead to.
  void expect_same_picture(const ProgramOutcome& outcome) const {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
    EXPECT_EQ(shell("\"$MINKRAY\" render scene.json -s 8 -o whole.pfm").exit_code, 0);
    EXPECT_EQ(text_of_file(folder_ / "whole.pfm"), text_of_file(folder_ / "a.pfm"));
    EXPECT_FALSE(fs::exists(folder_ / "a.pfm.parts"));
  }

  TemporaryFolder folder_;
};

class Mpi : public Drivers {
 protected:
  void SetUp() override {
    if (!has_mpi) GTEST_SKIP() << "built without MPI (libopenmpi-dev)";
    if (!has_program("mpirun")) GTEST_SKIP() << "needs mpirun (openmpi-bin)";
  }
  static constexpr const char* render =
      "mpirun --oversubscribe -n 4 \"$MINKRAY\" render scene.json -t 1 -s 8 -o a.pfm --tiles 9 ";
};

TEST_F(Mpi, four_ranks_make_the_same_picture_as_one) {
  const ProgramOutcome made = shell(render);
  expect_same_picture(made);
  for (const char* rank : {"rank 0 of 4 on ", "rank 3 of 4 on "})
    EXPECT_NE(made.err.find(rank), std::string::npos) << made.err;
  EXPECT_NE(made.err.find(": 1 thread"), std::string::npos) << made.err;
}

// A rank is killed when some tiles are there; what they are made of shows that they are kept.
TEST_F(Mpi, a_job_whose_rank_was_killed_goes_on_to_the_same_picture) {
  const ProgramOutcome killed = shell(R"sh(
    render() { mpirun --oversubscribe -n "$@" "$MINKRAY" render scene.json -t 1 -s 900 \
      -o a.pfm --tiles 48 --resume; }
    files() { ls -i a.pfm.parts/*.exr 2>/dev/null; }
    killed() {  # the last of four ranks, when there are some tiles more
      more=$(($(files | wc -l) + 3))
      render 4 & job=$!
      for i in $(seq 1 1000); do
        [ "$(files | wc -l)" -ge $more ] && break
        sleep 0.01
      done
      kill -9 "$(ps -o pid= --ppid "$(ps -o pid= --ppid $job)" | tail -1)"
      wait $job && exit 9
      [ ! -e a.pfm ] || exit 8
    }
    killed; files | sort > first
    killed; files | sort > second
    [ "$(wc -l < second)" -lt 48 ] || exit 7
    [ "$(comm -12 first second | wc -l)" -eq "$(wc -l < first)" ] || exit 6
    render 3 || exit 5
    "$MINKRAY" render scene.json -s 900 -o whole.pfm && cmp whole.pfm a.pfm)sh");
  EXPECT_EQ(killed.exit_code, 0) << killed.out << killed.err;
}

TEST_F(Mpi, mistakes_end_the_job_with_their_code) {
  EXPECT_EQ(shell("mpirun --oversubscribe -n 2 \"$MINKRAY\" render none.json -o a.pfm").exit_code,
            3);
  EXPECT_EQ(
      shell("mpirun --oversubscribe -n 2 \"$MINKRAY\" render scene.json -o none/a.pfm").exit_code,
      4);
  EXPECT_EQ(shell("\"$MINKRAY\" render scene.json -o a.pfm --tiles 4").exit_code, 2);
}

TEST_F(Drivers, without_mpi_several_ranks_are_told_so) {
  if (has_mpi) GTEST_SKIP() << "built with MPI";
  const ProgramOutcome outcome =
      shell("OMPI_COMM_WORLD_SIZE=4 \"$MINKRAY\" render scene.json -o a.pfm");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("built without MPI"), std::string::npos);
}

TEST_F(Drivers, gnu_parallel) {
  if (!has_program("parallel")) GTEST_SKIP() << "needs GNU parallel";
  expect_same_picture(shell("\"$DRIVERS/render-parallel\" scene.json a.pfm 5 -s 8"));
  // A tile fails: the job does, and goes on when it is run again.
  const ProgramOutcome failed = shell(
      "mkdir -p b.pfm.parts/2-of-3.exr; \"$DRIVERS/render-parallel\" scene.json b.pfm 3 -s 8");
  EXPECT_NE(failed.exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "b.pfm"));
  EXPECT_TRUE(fs::exists(folder_ / "b.pfm.parts/1-of-3.exr"));
  const ProgramOutcome again = shell(
      "rmdir b.pfm.parts/2-of-3.exr; \"$DRIVERS/render-parallel\" scene.json b.pfm 3 -s 8 && "
      "cmp a.pfm b.pfm");
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

// There is no Slurm here: the stand-in runs each task as sbatch's manual says, with the array's
// variables, one after the other, and refuses options that it does not know.
TEST_F(Drivers, slurm_array) {
  std::ofstream(folder_ / "sbatch") << R"(#!/usr/bin/env bash
for word in "$@"; do
  case "$word" in
    --array=1-*) tasks="${word#--array=1-}" ;;
    --wrap=*) script="${word#--wrap=}" ;;
    --dependency=afterok:17 | --parsable | --requeue | --signal=TERM@60) ;;
    --cpus-per-task=* | --job-name=* | --output=*) ;;
    *) echo "sbatch: $word" >&2; exit 1 ;;
  esac
done
for task in $(seq 1 "${tasks:-1}"); do
  [ -z "$tasks" ] || export SLURM_ARRAY_TASK_ID=$task
  sh -c "$script" || exit 1
done
echo 17
)";
  expect_same_picture(shell(
      "chmod +x sbatch; PATH=\"$PWD:$PATH\"; \"$DRIVERS/render-slurm\" scene.json a.pfm 4 -s 8"));
}

}  // namespace
}  // namespace minkray
