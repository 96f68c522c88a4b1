// SPDX-License-Identifier: MIT
// Pictures that several processes share, on one machine: Open MPI, GNU parallel, and Slurm's array
// jobs with a stand-in for sbatch.
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "renderer/share/ranks.h"
#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

/// It is, for a shell, the name of a picture with what means something to shells, to printf and to
/// sbatch.
constexpr const char* strange_name = R"('it'\''s "100%A", %d $HOME	a\b&ö;.pfm')";

class Drivers : public testing::Test {
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
    allow_root();
    ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);  // Open MPI's own, where a sanitizer looks
  }
  void allow_root() {
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  }

  /// The tiles' files that are there, and their numbers.
  std::map<std::string, ino_t> tiles() const {
    std::map<std::string, ino_t> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_ / "a.pfm.parts", error)) {
      struct stat status = {};
      if (entry.path().extension() == ".exr" && ::stat(entry.path().c_str(), &status) == 0)
        found[entry.path().filename().string()] = status.st_ino;
    }
    return found;
  }

  bool has_picture() const { return fs::exists(folder_ / "a.pfm"); }

  /// None once it has ended.
  static std::vector<pid_t> children_of(pid_t parent) {
    std::vector<pid_t> children;
    const std::string tasks = "/proc/" + std::to_string(parent) + "/task";
    std::error_code error;
    for (const auto& task : fs::directory_iterator(tasks, error)) {
      std::istringstream list(text_of_file(task.path() / "children"));
      for (pid_t child = 0; list >> child;) children.push_back(child);
    }
    return children;
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

// A rank is killed when some tiles are there, and a rank of the next job as well. The files'
// numbers (inodes) show that what was there is kept. A job that is over before its rank can be
// killed is begun anew with more samples.
TEST_F(Mpi, a_job_whose_rank_was_killed_goes_on_to_the_same_picture) {
  int samples = 2000, kills = 0;
  const auto start = [&](const char* ranks) {
    return start_program({"mpirun", "--oversubscribe", "-n", ranks, minkray_program(), "render",
                          folder_ / "scene.json", "-t", "1", "-s", std::to_string(samples), "-o",
                          folder_ / "a.pfm", "--resume", "--tiles", "48"});
  };
  /// Starts a job and kills a rank when there are three more tiles: whether it came to that.
  const auto killed = [&](const std::map<std::string, ino_t>& before) {
    const pid_t job = start("4");
    for (int i = 0; i < 60000 && tiles().size() < before.size() + 3 && !has_picture(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::vector<pid_t> ranks = children_of(job);
    if (ranks.size() == 4) ::kill(ranks.back(), SIGKILL);
    const int status = wait_for(job);
    EXPECT_TRUE(ranks.size() == 4 || status == 0);
    return status != 0 && !has_picture();  // with the picture the job was as good as over
  };
  for (; kills < 2; samples *= 4) {
    ASSERT_LE(samples, 128000) << "however long it is, the job is over before a rank is killed";
    fs::remove(folder_ / "a.pfm");
    fs::remove_all(folder_ / "a.pfm.parts");
    std::map<std::string, ino_t> before;
    for (kills = 0; kills < 2 && killed(before); ++kills) {
      const std::map<std::string, ino_t> after = tiles();
      EXPECT_GE(after.size(), before.size() + 3);
      for (const auto& [name, inode] : before) EXPECT_EQ(after.at(name), inode) << name;
      before = after;
    }
    if (kills == 2) break;
  }
  EXPECT_EQ(wait_for(start("3")), 0);
  EXPECT_FALSE(fs::exists(folder_ / "a.pfm.parts"));
  EXPECT_EQ(wait_for(start_minkray({"render", folder_ / "scene.json", "-s", std::to_string(samples),
                                    "-o", folder_ / "whole.pfm"})),
            0);
  EXPECT_EQ(text_of_file(folder_ / "a.pfm"), text_of_file(folder_ / "whole.pfm"));
}

// What ranks that were killed left goes with the tiles; what is not the picture's stays.
TEST_F(Mpi, files_of_others_beside_the_tiles_stay) {
  const std::string parts = folder_ / "a.pfm.parts/";
  fs::create_directory(parts);
  for (const char* name : {"notes.txt", "000001-of-000010.exr", "000001-of-000009.exr.checkpoint",
                           ".000002-of-000009.exr.123.0123abcd.tmp",
                           ".000002-of-000009.exr.checkpoint.1.0123abcd.tmp"})
    std::ofstream(parts + name) << "\x76\x2f\x31\x01";
  const ProgramOutcome made = shell(render);
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("note: a.pfm.parts stays, for there is more in it"), std::string::npos)
      << made.err;
  EXPECT_EQ(tiles().size(), 1u);
  EXPECT_EQ(std::distance(fs::directory_iterator(parts), fs::directory_iterator()), 2);
  EXPECT_TRUE(fs::exists(parts + "notes.txt"));
  EXPECT_TRUE(fs::exists(parts + "000001-of-000010.exr"));
}

TEST_F(Mpi, ranks_tell_their_threads_and_warn_where_they_are_pinned_to_one_core) {
  if (!has_program("taskset")) GTEST_SKIP() << "needs taskset (util-linux)";
  if (::sysconf(_SC_NPROCESSORS_ONLN) < 2) GTEST_SKIP() << "needs two cores";
  cpu_set_t cores;
  CPU_ZERO(&cores);
  ASSERT_EQ(::sched_getaffinity(0, sizeof cores, &cores), 0);
  int core = 0;
  while (!CPU_ISSET(core, &cores)) ++core;
  const auto run = [&](const std::string& pin) {
    return shell("mpirun --oversubscribe --bind-to none -n 2 " + pin +
                 " \"$MINKRAY\" render scene.json -s 1 -t 3 -o a.pfm --tiles 2");
  };
  const ProgramOutcome pinned = run("taskset -c " + std::to_string(core));
  EXPECT_EQ(pinned.exit_code, 0) << pinned.err;
  for (const std::string rank : {"rank 0 of 2", "rank 1 of 2"}) {
    EXPECT_NE(pinned.err.find("warning: " + rank + " is pinned to one of "), std::string::npos)
        << pinned.err;
    EXPECT_NE(pinned.err.find(rank + " on "), std::string::npos) << pinned.err;
  }
  EXPECT_NE(pinned.err.find(": 3 threads\n"), std::string::npos) << pinned.err;
  if (CPU_COUNT(&cores) > 1) {
    EXPECT_EQ(run("").err.find("is pinned"), std::string::npos);
  }
}

// Only rank 0 writes the picture: the others are ended with it, and leave nothing behind.
TEST_F(Mpi, mistakes_end_the_job_with_their_code) {
  const ProgramOutcome outcome =
      shell("mpirun --oversubscribe -n 2 \"$MINKRAY\" render scene.json -o none/a.pfm");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot write none/a.pfm: "), std::string::npos) << outcome.err;
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
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
  EXPECT_FALSE(fs::exists(folder_ / "b.pfm.parts"));
  // What is not the picture's stays.
  const ProgramOutcome noted = shell(
      "mkdir b.pfm.parts; cd b.pfm.parts; echo x > notes.txt; touch .1-of-3.exr.7.0123abcd.tmp; "
      "cd ..; \"$DRIVERS/render-parallel\" scene.json b.pfm 3 -s 8 && ls -A b.pfm.parts");
  EXPECT_EQ(noted.exit_code, 0) << noted.err;
  EXPECT_EQ(noted.out, "notes.txt\n");
  EXPECT_NE(noted.err.find("note: b.pfm.parts stays"), std::string::npos) << noted.err;
  const ProgramOutcome strange =
      shell(std::string("name=") + strange_name +
            "; \"$DRIVERS/render-parallel\" scene.json \"$name\" 3 -s 8 && cmp a.pfm \"$name\" && "
            "! test -e \"$name.parts\"");
  EXPECT_EQ(strange.exit_code, 0) << strange.err;
}

TEST_F(Drivers, numbers_of_tiles_are_whole_numbers) {
  for (const std::string driver : {"parallel", "slurm"})
    for (const std::string count : {"0", "-1", "1.5", "08", "many", "''"}) {
      const ProgramOutcome outcome =
          shell("\"$DRIVERS/render-" + driver + "\" scene.json a.pfm " + count);
      EXPECT_EQ(outcome.exit_code, 2) << driver << count;
      EXPECT_NE(outcome.err.find("N must be a whole number >= 1"), std::string::npos)
          << outcome.err;
    }
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
}

// There is no Slurm here: the stand-in runs each task as sbatch's manual says, with the array's
// variables and logs, one after the other, and refuses options that it does not know, arrays that
// are too large, patterns that it does not know in a log's name, jobs after the $LAST_JOB-th, and
// jobs that depend on others than those there were. It counts jobs from 17.
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
  EXPECT_NE(split.out.find("4\nnotes.txt\nnote: b%.pfm.parts stays"), std::string::npos)
      << split.out;
  const ProgramOutcome strange =
      shell(prepare + "name=" + strange_name +
            "; \"$DRIVERS/render-slurm\" scene.json \"$name\" 3 -s 8 && cmp a.pfm \"$name\" && "
            "! test -e \"$name.parts\" && test -e \"$name.log\"");
  EXPECT_EQ(strange.exit_code, 0) << strange.out << strange.err;
  // The third array is refused: the first two are named, for nothing will merge their tiles.
  const ProgramOutcome refused =
      shell(prepare + "export LAST_JOB=2; \"$DRIVERS/render-slurm\" scene.json c.pfm 5 -s 8");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("no job will merge"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("scancel 17 18\n"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace minkray
