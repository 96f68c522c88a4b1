// SPDX-License-Identifier: MIT
#include "renderer/cli/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "core/files/text.h"
#include "renderer/cli/help_page.h"
#include "renderer/cli/usage_errors.h"
#include "renderer/cli/verbs.h"
#include "renderer/cli/words_meant.h"

namespace minkray {

Option Option::required(bool is_required) const {
  option_->required(is_required);
  return *this;
}

Option Option::show_default() const {
  option_->capture_default_str();
  return *this;
}

Option Option::between(int least, int most) const {
  option_->check(CLI::Range(least, most));
  return *this;
}

Option Option::between(double least, double most) const {
  const CLI::Validator inside = CLI::Range(least, most);
  CLI::Validator range = inside;
  // NaN is neither less than one end nor greater than the other.
  range.operation([inside](const std::string& text) {
    double number = 0;
    if (CLI::detail::lexical_cast(text, number) && std::isnan(number))
      return std::string("must be a number (got nan)");
    return inside(text);
  });
  option_->check(range);
  return *this;
}

Option Option::between(std::size_t least, std::size_t most) const {
  option_->check(CLI::Range(least, most));
  return *this;
}

Option Option::one_of(const std::vector<std::string>& names) const {
  option_->check(CLI::Validator(
      [names](const std::string& value) -> std::string {
        if (std::ranges::find(names, value) != names.end()) return "";
        const std::string meant = value_meant(value, names);
        return "must be one of " + listed(names) + " (got " + value + ")" +
               (meant.empty() ? "" : "; " + meant);
      },
      "{" + listed(names, {}, ",") + "}"));
  return *this;
}

Option Option::values(int count, char delimiter) const {
  option_->expected(count)->delimiter(delimiter);
  return *this;
}

Option Option::one_value_each() const {
  option_->allow_extra_args(false);
  return *this;
}

Option Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}

Option Option::group(const std::string& heading) const {
  option_->group(heading);
  return *this;
}

Option Option::takes(const std::string& what) const {
  option_->type_name(what);
  return *this;
}

Option Option::reads_file() const {
  files_->push_back({option_, FileRole::read});
  return takes("FILE");
}

Option Option::writes_file() const {
  files_->push_back({option_, FileRole::written});
  return takes("OUTPUT");
}

Option Option::takes_folder() const {
  return takes("FOLDER");
}

Option Option::replace(const std::function<std::string(const std::string&)>& function) const {
  option_->transform(CLI::Validator(
      [function](std::string& value) {
        value = function(value);
        return std::string();
      },
      ""));
  return *this;
}

Option Verb::add_option(const std::string& names, std::string& value,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc), state_->options);
}

Option Verb::add_option(const std::string& names, int& value, const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc), state_->options);
}

Option Verb::add_option(const std::string& names, std::size_t& value,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc), state_->options);
}

Option Verb::add_option(const std::string& names, unsigned& value, const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc), state_->options);
}

Option Verb::add_option(const std::string& names, double& value, const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc), state_->options);
}

Option Verb::add_option(const std::string& names, std::optional<std::string>& value,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc), state_->options);
}

Option Verb::add_option(const std::string& names, std::optional<int>& value,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc), state_->options);
}

Option Verb::add_option(const std::string& names, std::vector<std::string>& values,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, values, doc), state_->options);
}

Option Verb::add_option(const std::string& names, std::vector<int>& values,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, values, doc), state_->options);
}

Option Verb::add_option(const std::string& names,
                        const std::function<void(const std::string&)>& function,
                        const std::string& doc) const {
  return Option(*verb_->add_option_function<std::string>(names, function, doc), state_->options);
}

Option Verb::add_flag(const std::string& names, bool& is_given, const std::string& doc) const {
  return Option(*verb_->add_flag(names, is_given, doc), state_->options);
}

Option Verb::add_flag(const std::string& names, std::string& value, const std::string& doc) const {
  return Option(*verb_->add_flag(names, value, doc), state_->options);
}

CommandFiles& Verb::files() const {
  return state_->files;
}

void Verb::on_call(const std::function<void()>& function) const {
  verb_->callback([state = state_, function] {
    for (const FileRole role : {FileRole::read, FileRole::written})
      for (const FileOption& one : state->options) {
        if (one.role != role) continue;
        for (const std::string& file : one.option->results())
          if (role == FileRole::read)
            state->files.read(file);
          else
            state->files.write(file, one.option->get_name());
      }
    function();
  });
}

void Parser::set_version(const std::string& version) {
  app_->set_version_flag("--version", version);
}

void Parser::set_footer(const std::string& text) {
  app_->footer(text);
}

Verb Parser::add_verb(const std::string& name) {
  for (const VerbRow& row : minkray::verbs)
    if (row.name == name)
      return Verb(*app_->add_subcommand(name, std::string(row.doc)), states_[name]);
  throw std::logic_error("no such verb: " + name);
}

namespace {

/// Choices in the braces of a type's name such as "TEXT:{quality,speed}".
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.rfind('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  return pieces_of(type.substr(open + 1, close - open - 1), ',');
}

/// Name of a value, from a type's name such as "INT:INT in [0 - 64]", "HOST:PORT" or "TEXT:{a,b}".
std::string value_in(const std::string& type) {
  const std::size_t range = type.find(" in [");
  const std::size_t end = range == type.npos ? type.find(":{") : type.rfind(':', range);
  const std::string value = type.substr(0, end);
  if (value == "INT" || value == "UINT") return "N";
  return value == "FLOAT" ? "X" : value;
}

/// "0 to 64", from a type's name such as "INT:INT in [0 - 64]".
std::string range_in(const std::string& type) {
  const std::size_t open = type.find(" in ["), close = type.rfind(']');
  if (open == type.npos || close == type.npos) return "";
  std::string range = type.substr(open + 5, close - open - 5);
  if (const std::size_t dash = range.find(" - "); dash != range.npos)
    range.replace(dash, 3, " to ");
  return range;
}

OptionDescription describe(const CLI::Option& option) {
  OptionDescription description;
  for (const std::string& name : option.get_snames()) description.flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) description.flags.push_back("--" + name);
  if (option.get_positional()) description.place = option.get_name(true);
  const std::string type = option.get_type_name();
  description.choices = choices_in(type);
  const bool takes_value = option.get_items_expected_max() > 0;
  description.is_value_optional = !takes_value && !description.choices.empty();
  if (takes_value || description.is_value_optional) {
    description.value = description.choices.empty() ? value_in(type) : "NAME";
    description.range = range_in(type);
  }
  description.group = option.get_group();
  description.is_required = option.get_required();
  description.is_repeated = option.get_expected_max() > 1;
  description.default_value = option.get_default_str();
  description.doc = option.get_description();
  return description;
}

VerbDescription describe(const CLI::App& verb) {
  VerbDescription description{verb.get_name(), verb.get_description(), {}, {}};
  for (const VerbRow& row : minkray::verbs)
    if (row.name == verb.get_name()) {
      description.examples.assign(std::begin(row.examples), std::end(row.examples));
      description.exit_codes = row.exit_codes;
    }
  for (const CLI::Option* option : verb.get_options(nullptr))
    description.options.push_back(describe(*option));
  return description;
}

/// Own help pages, since the library's have lines of any length.
class HelpPages : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const override {
    if (app->get_parent() != nullptr) return help_page(describe(*app));
    std::vector<VerbDescription> verbs;
    for (const CLI::App* verb : app->get_subcommands(nullptr)) verbs.push_back(describe(*verb));
    return help_page(verbs, app->get_description(), app->get_footer());
  }
};

/// Message for words that no option takes: "unknown option `--samples`; did you mean ...".
std::string unknown_word(const CLI::App& verb) {
  const std::vector<std::string> words = verb.remaining();
  if (words.empty()) return "";
  // A mistyped option leaves its value, too; the library returns the words in any order.
  const auto flag = std::ranges::find_if(words, [](const std::string& word) {
    return word.size() > 1 && word[0] == '-' &&
           std::isdigit(static_cast<unsigned char>(word[1])) == 0;
  });
  const std::string help = "minkray " + verb.get_name() + " --help";
  if (flag == words.end())
    return "unexpected argument `" + words.front() + "` (" + help + " shows what it takes)\n";
  std::vector<std::string> options;
  for (const CLI::Option* option : verb.get_options(nullptr))
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  const std::string word = flag->substr(0, flag->find('='));
  const std::string meant = option_meant(word, options);
  return "unknown option `" + word + "`" +
         (meant.empty() ? " (" + help + " lists all)" : "; " + meant) + "\n";
}

}  // namespace

std::vector<std::string> Parser::verb_names() const {
  std::vector<std::string> names;
  for (const CLI::App* verb : app_->get_subcommands(nullptr)) names.push_back(verb->get_name());
  return names;
}

std::vector<VerbDescription> Parser::verbs() const {
  std::vector<VerbDescription> verbs;
  for (const CLI::App* verb : app_->get_subcommands(nullptr))
    if (!verb->get_name().empty()) verbs.push_back(describe(*verb));
  return verbs;
}

Parser::Parser(const std::string& doc, const std::string& program)
    : app_(std::make_unique<CLI::App>(doc, program)) {
  app_->require_subcommand(1);
  app_->formatter(std::make_shared<HelpPages>());
}

Parser::~Parser() = default;

std::string Parser::parse(const std::vector<std::string>& words) {
  std::ostringstream complaints;
  try {
    // The library expects the words in reverse order, without the program's name.
    app_->parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));
  } catch (const CLI::ParseError& error) {
    const bool is_help = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    for (const CLI::App* verb : app_->get_subcommands())
      if (const std::string unknown = unknown_word(*verb); !is_help && !unknown.empty())
        return unknown;
    app_->exit(error, std::cout, complaints);
  }
  const std::string complaint = complaints.str();
  const std::size_t end = std::min(complaint.find('\n'), complaint.size());
  return usage_error(complaint.substr(0, end)) + complaint.substr(end);
}

}  // namespace minkray
