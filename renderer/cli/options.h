// SPDX-License-Identifier: MIT
// The command line that verbs describe themselves to: options, what they accept, and what runs. The
// library that reads it, CLI11, is seen by options.cpp alone, for its templates take seconds to
// compile in each file that includes them (docs/decisions/build.md).
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

/// An option that was added. Each function says more of it and answers the same option.
class Option {
 public:
  Option(CLI::Option& option, std::vector<FileOption>& files) : option_(&option), files_(&files) {}

  Option required(bool is_required = true) const;
  /// Help shows the value that the variable has now.
  Option show_default() const;
  /// Both ends are allowed.
  Option between(int least, int most) const;
  Option between(double least, double most) const;
  Option between(std::size_t least, std::size_t most) const;
  Option one_of(const std::vector<std::string>& names) const;
  /// So many values with the delimiter between them.
  Option values(int count, char delimiter) const;
  /// Each time it is given it takes one value, so that what is behind is given by its place.
  Option one_value_each() const;
  Option excludes(const Option& other) const;
  /// The heading in help that it stands under.
  Option group(const std::string& heading) const;
  /// Names in help what a value is: "NAME", "WxH". Text that is no file's name must say so.
  Option takes(const std::string& what) const;
  /// Values are files that the command reads ("FILE" in help), writes ("OUTPUT"), or folders.
  Option reads_file() const;
  Option writes_file() const;
  Option takes_folder() const;
  /// The variable gets what the function makes of what was given.
  Option replace(const std::function<std::string(const std::string&)>& function) const;

 private:
  CLI::Option* option_;
  std::vector<FileOption>* files_;
};

/// A subcommand. The variables of its options must outlive the parser.
class Verb {
 public:
  struct State;
  Verb(CLI::App& verb, State& state) : verb_(&verb), state_(&state) {}

  /// The files of this command, which all that it opens are to be added to: before `on_call`'s
  /// function runs, those that options name have been added.
  CommandFiles& files() const;

  /// `names` is "-o,--output" for what is given by its name, "scene" for what is given by its
  /// place. Lists take all words that follow, unless one_value_each.
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
  /// The function is called with the value that was given.
  Option add_option(const std::string& names,
                    const std::function<void(const std::string&)>& function,
                    const std::string& doc) const;

  Option add_flag(const std::string& names, bool& is_given, const std::string& doc) const;
  /// A flag that may have a value behind a "="; "true" or what `names` has in braces if it has
  /// none.
  Option add_flag(const std::string& names, std::string& value, const std::string& doc) const;

  /// What the verb does, once all of its options are read.
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

  /// What --version prints.
  void set_version(const std::string& version);
  /// What help ends with.
  void set_footer(const std::string& text);
  /// Adds one of the verbs that there are (renderer/cli/verbs.h).
  Verb add_verb(const std::string& name);

  /// They come in the order in which they were added.
  std::vector<std::string> verb_names() const;
  std::vector<VerbDescription> verbs() const;

  /// Reads the options and runs the verb; help and the version go to stdout. Answers what is wrong
  /// with the words, for stderr; empty: nothing. Lets through what the verb throws.
  std::string parse(const std::vector<std::string>& words);

 private:
  std::unique_ptr<CLI::App> app_;
  std::map<std::string, Verb::State> states_;  ///< by verb
};

}  // namespace minkray
