// SPDX-License-Identifier: MIT
#include "tests/support/program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "tests/support/source_files.h"

namespace minkray {

pid_t start_program(std::vector<std::string> words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::fflush(nullptr);  // or the child would write what waits, too
  const pid_t child = ::fork();
  // Killing process -1 kills all there are.
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    // Under nohup, or in a shell's background, it would ignore what the test sends it.
    for (const int signal : {SIGHUP, SIGINT, SIGQUIT}) std::signal(signal, SIG_DFL);
    if (std::freopen("/dev/null", "w", stdout) == nullptr) ::_exit(126);
    if (std::freopen("/dev/null", "w", stderr) == nullptr) ::_exit(126);
    ::execvp(pointers[0], pointers.data());
    ::_exit(127);
  }
  return child;
}

std::string minkray_program() {
  return MINKRAY_PROGRAM;
}

pid_t start_minkray(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {MINKRAY_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return start_program(std::move(words));
}

int wait_for(pid_t process) {
  int status = 0;
  ::waitpid(process, &status, 0);
  return status;
}

ProgramOutcome run_shell(const std::string& command) {
  const TemporaryFolder folder;
  const std::string out = folder / "out", err = folder / "err";
  const std::string line = "MINKRAY='" MINKRAY_PROGRAM "'; export MINKRAY; ( " + command +
                           "\n) >'" + out + "' 2>'" + err + "'";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of_file(out), text_of_file(err)};
}

ProgramOutcome run_in(const TemporaryFolder& folder, const std::string& command) {
  return run_shell("cd '" + folder.path().string() + "' || exit 99\n" + command);
}

std::string limited_memory() {
#if defined(__SANITIZE_ADDRESS__)
  return "";
#else
  return "ulimit -v 1048576; ";
#endif
}

void write_ball_scene(const std::string& file, double radius) {
  std::ofstream(file) << R"({"version": 1,
  "camera": {"position": [0, -5, 1], "look_at": [0, 0, 0], "up": [0, 0, 1], "fov_y_degrees": 40,
             "resolution": [64, 48]},
  "lights": [{"type": "environment", "zenith": [1, 1, 1], "nadir": [0.3, 0.2, 0.1]}],
  "materials": [{"name": "glossy", "type": "glossy", "color": [0.7, 0.5, 0.3]}],
  "objects": [{"name": "ball", "shape": {"type": "sphere", "radius": )"
                      << radius << R"(}, "material": "glossy"}]})";
}

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace minkray
