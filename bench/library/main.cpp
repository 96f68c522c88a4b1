// SPDX-License-Identifier: MIT
// Compares the installed library with Embree 3 and Bullet. Prints a table; exit code 1 if a goal is
// missed or results disagree.
//   library-bench [--rounds N] [--only REGEX] [--quick] [-o FILE] [--python CMD] [--commit TEXT]
// Each section runs in its own process, so no section sees the heap or the threads of another.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <regex>
#include <stdexcept>

#include "sections.h"

namespace {

using namespace bench;

constexpr unsigned most_seconds = 3600;  ///< of a section, on a busy machine
constexpr int failed = 1, wrong_usage = 2, cannot_write = 4;

struct Command {
  Options options;
  std::string output, commit = "unknown";
  std::string only;  ///< a regular expression; empty: all sections
  bool quick = false;
  int section = -1;  ///< of a process that runs one of them
};

int number(const std::string& name, const char* text) {
  char* end = nullptr;
  const long value = std::strtol(text, &end, 10);
  if (end == text || *end || value < 0 || value > 10'000)
    throw std::invalid_argument(name + ": must be a number from 0 to 10000 (got " + text + ")");
  return static_cast<int>(value);
}

Command read_command(int count, char** words) {
  Command command;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--quick") {
      command.quick = true;
      command.options.side = 256;
      command.options.queries = 200;
      command.options.rounds = 2;
      continue;
    }
    if (word != "--rounds" && word != "--only" && word != "-o" && word != "--python" &&
        word != "--commit" && word != "--section")
      throw std::invalid_argument(word + ": must be an option (./run bench --help)");
    if (++i == count) throw std::invalid_argument(word + ": must have a value");
    if (word == "--rounds")
      command.options.rounds = std::max(1, number(word, words[i]));
    else if (word == "--section")
      command.section = number(word, words[i]);
    else
      (word == "-o"         ? command.output
       : word == "--only"   ? command.only
       : word == "--python" ? command.options.python
                            : command.commit) = words[i];
  }
  return command;
}

std::string machine() {
  std::ifstream processors("/proc/cpuinfo");
  for (std::string line; std::getline(processors, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown machine";
}

/// Runs one section in a process of its own; prints and returns its rows.
std::string output_of(const std::vector<std::string>& words, const std::string& name) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // ends with this process
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    std::vector<char*> plain;
    for (const std::string& word : words) plain.push_back(const_cast<char*>(word.c_str()));
    plain.push_back(nullptr);
    execv("/proc/self/exe", plain.data());
    _exit(127);
  }
  close(ends[1]);
  std::string text;
  char part[4096];
  for (ssize_t bytes; (bytes = read(ends[0], part, sizeof part)) > 0;) {
    text.append(part, static_cast<std::size_t>(bytes));
    std::cout.write(part, bytes).flush();
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) <= failed) return text;
  const std::string row = "| " + name + " | | | | | | FAILED | | |\n";
  std::cout << row << std::flush;
  return text + row;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

/// A file that is written as a whole or not at all.
class Output {
 public:
  explicit Output(std::string name) : name_(std::move(name)) {
    if (!name_.empty() && !std::ofstream(part())) fail();
  }
  ~Output() {
    if (!name_.empty()) std::remove(part().c_str());
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void write(const std::string& text) {
    if (name_.empty()) return;
    std::ofstream out(part());
    out << text;
    out.close();
    if (!out || std::rename(part().c_str(), name_.c_str()) != 0) fail();
  }

 private:
  std::string part() const { return name_ + ".part"; }
  void fail() const {
    throw std::runtime_error("-o: cannot write " + name_ + ": " + std::strerror(errno));
  }
  std::string name_;
};

int run_all(const Command& command, int count, char** words) {
  const std::regex only(command.only);
  const std::vector<Section> sections = all_sections();
  if (std::none_of(sections.begin(), sections.end(),
                   [&](const Section& section) { return std::regex_search(section.name, only); }))
    throw std::invalid_argument("--only: must match a section (got " + command.only + ")");
  Output output(command.output);
  std::string text =
      std::string("# ./run bench") + (command.quick ? " --quick" : "") + " at " + command.commit +
      ", minkray " + mk::version() + ", " + machine() +
      "\n# one thread, processor time, the best of " + std::to_string(command.options.rounds) +
      " interleaved rounds; figures are peer / Minkray unless said\n" + Table::head();
  std::cout << text << std::flush;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (!std::regex_search(sections[i].name, only)) continue;
    std::vector<std::string> all(words, words + count);
    all.insert(all.end(), {"--section", std::to_string(i)});
    text += output_of(all, sections[i].name);
  }
  const std::size_t ok = count_of(text, "| ok |"), missed = count_of(text, "| MISS |"),
                    bad = count_of(text, "| DISAGREE |") + count_of(text, "| FAILED |");
  const std::string sum = "\n" + std::to_string(ok) + " of " + std::to_string(ok + missed + bad) +
                          " goals are met, " + std::to_string(bad) + " rows are no result\n";
  std::cout << sum << std::flush;
  output.write(text + sum);
  return missed + bad == 0 ? 0 : failed;
}

}  // namespace

int main(int count, char** words) {
  try {
    const Command command = read_command(count, words);
    if (command.section < 0) return run_all(command, count, words);
    // A peer that does not return costs its section only. (A limit of processor time would make the
    // processor's clock as coarse as the kernel's ticks.)
    alarm(most_seconds);
    Table table(stdout);
    all_sections().at(static_cast<std::size_t>(command.section)).run(table, command.options);
    return table.all_good() ? 0 : failed;
  } catch (const std::invalid_argument& error) {
    std::cerr << "library-bench: " << error.what() << "\n";
    return wrong_usage;
  } catch (const std::regex_error& error) {
    std::cerr << "library-bench: --only: must be a regular expression (" << error.what() << ")\n";
    return wrong_usage;
  } catch (const std::exception& error) {
    std::cerr << "library-bench: " << error.what() << "\n";
    return cannot_write;
  }
}
