// SPDX-License-Identifier: MIT
// Command line to which commands add their options: names, accepted values, and the function to
// run. Only options.cpp includes the parser library, CLI11, whose templates take seconds to compile
// in each file that includes them (docs/decisions/build.md).
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/cli/command_files.h"
#include "renderer/cli/verb_description.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace minkray {

enum class FileRole : unsigned char { read, written };

/// An option whose values are files.
struct FileOption {
  CLI::Option* option;
  FileRole role;
};

/// An option that was added. Each function sets a property and returns the same option.
class Option {
 public:
  Option(CLI::Option& option, std::vector<FileOption>& files) : option_(&option), files_(&files) {}

  Option required(bool is_required = true) const;
  /// Shows the variable's current value in help.
  Option show_default() const;
  /// Sets the range, including both ends.
  Option between(int least, int most) const;
  Option between(double least, double most) const;
  Option between(std::size_t least, std::size_t most) const;
  Option one_of(const std::vector<std::string>& names) const;
  /// Takes `count` values, separated by the delimiter.
  Option values(int count, char delimiter) const;
  /// Takes one value per occurrence, so that positional arguments may follow.
  Option one_value_each() const;
  Option excludes(const Option& other) const;
  /// Sets the heading of the option in help.
  Option group(const std::string& heading) const;
  /// Sets the name of the value in help: "NAME", "WxH". Required for text that is not a file's
  /// name.
  Option takes(const std::string& what) const;
  /// Marks values as files that the command reads ("FILE" in help), writes ("OUTPUT"), or as
  /// folders.
  Option reads_file() const;
  Option writes_file() const;
  Option takes_folder() const;
  /// Stores the function's result for the given value in the variable.
  Option replace(const std::function<std::string(const std::string&)>& function) const;

 private:
  CLI::Option* option_;
  std::vector<FileOption>* files_;
};

/// A subcommand. Variables of its options must outlive the parser.
class Verb {
 public:
  struct State;
  Verb(CLI::App& verb, State& state) : verb_(&verb), state_(&state) {}

  /// Files of this command. Add all files that it opens; those named by options are added before
  /// the function of `on_call` runs.
  CommandFiles& files() const;

  /// `names` is "-o,--output" for an option, "scene" for a positional argument. Lists take all
  /// words that follow, unless one_value_each.
  Option add_option(const std::string& names, std::string& value, const std::string& doc) const;
  Option add_option(const std::string& names, int& value, const std::string& doc) const;
  Option add_option(const std::string& names, unsigned& value, const std::string& doc) const;
  Option add_option(const std::string& names, std::size_t& value, const std::string& doc) const;
  Option add_option(const std::string& names, double& value, const std::string& doc) const;
  Option add_option(const std::string& names, std::optional<std::string>& value,
                    const std::string& doc) const;
  Option add_option(const std::string& names, std::optional<int>& value,
                    const std::string& doc) const;
  Option add_option(const std::string& names, std::vector<std::string>& values,
                    const std::string& doc) const;
  Option add_option(const std::string& names, std::vector<int>& values,
                    const std::string& doc) const;
  /// Calls the function with the given value.
  Option add_option(const std::string& names,
                    const std::function<void(const std::string&)>& function,
                    const std::string& doc) const;

  Option add_flag(const std::string& names, bool& is_given, const std::string& doc) const;
  /// Adds a flag with an optional value after "=". Without one, the value is "true" or the text
  /// that `names` has in braces.
  Option add_flag(const std::string& names, std::string& value, const std::string& doc) const;

  /// Sets the function to run once all options are read.
  void on_call(const std::function<void()>& function) const;

 private:
  CLI::App* verb_;
  State* state_;
};

struct Verb::State {
  CommandFiles files;
  std::vector<FileOption> options;
};

/// The whole command line.
class Parser {
 public:
  Parser(const std::string& doc, const std::string& program);
  ~Parser();

  /// Sets the output of --version.
  void set_version(const std::string& version);
  /// Sets the end of the help.
  void set_footer(const std::string& text);
  /// Adds one of the existing commands (renderer/cli/verbs.h).
  Verb add_verb(const std::string& name);

  /// Names in the order in which they were added.
  std::vector<std::string> verb_names() const;
  std::vector<VerbDescription> verbs() const;

  /// Reads the options and runs the command; help and the version go to stdout. Returns errors in
  /// the words, for stderr; empty if there are none. Passes on exceptions of the command.
  std::string parse(const std::vector<std::string>& words);

 private:
  std::unique_ptr<CLI::App> app_;
  std::map<std::string, Verb::State> states_;  ///< by verb
};

}  // namespace minkray
