// SPDX-License-Identifier: MIT
// The program minkray as its users meet it.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace minkray {

/// Starts a program, looked for in PATH, with its output thrown away; the process is to be waited
/// for.
pid_t start_program(std::vector<std::string> words);
pid_t start_minkray(const std::vector<std::string>& arguments);

/// The file name of the program minkray.
std::string minkray_program();

/// The status as waitpid has it.
int wait_for(pid_t process);

struct ProgramOutcome {
  int exit_code = -1;  ///< -1: ended by a signal
  std::string out, err;
};

/// Runs a shell's command in which $MINKRAY is the program; in a folder.
ProgramOutcome run_shell(const std::string& command);
ProgramOutcome run_in(const TemporaryFolder& folder, const std::string& command);

/// Runs the program with a shell's words; in a folder.
inline ProgramOutcome run_minkray(const std::string& words) {
  return run_shell("\"$MINKRAY\" " + words);
}
inline ProgramOutcome run_minkray(const TemporaryFolder& folder, const std::string& words) {
  return run_in(folder, "\"$MINKRAY\" " + words);
}

/// Limits the shell's next commands to 1 GiB of address space. Empty under AddressSanitizer, which
/// needs terabytes of it.
std::string limited_memory();

/// Writes a small scene: a ball under an even sky; `radius` makes another one.
void write_ball_scene(const std::string& file, double radius = 1);

/// True if a shell finds a program of that name.
bool has_program(const std::string& name);

}  // namespace minkray
