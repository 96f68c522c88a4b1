// SPDX-License-Identifier: MIT
#include "renderer/cli/options.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "renderer/cli/verbs.h"

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
  option_->check(CLI::Range(least, most));
  return *this;
}

Option Option::between(std::size_t least, std::size_t most) const {
  option_->check(CLI::Range(least, most));
  return *this;
}

Option Option::one_of(const std::vector<std::string>& names) const {
  option_->check(CLI::IsMember(names));
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
  return Option(*verb_->add_option(names, value, doc));
}

Option Verb::add_option(const std::string& names, int& value, const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc));
}

Option Verb::add_option(const std::string& names, std::size_t& value,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc));
}

Option Verb::add_option(const std::string& names, unsigned& value, const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc));
}

Option Verb::add_option(const std::string& names, double& value, const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc));
}

Option Verb::add_option(const std::string& names, std::optional<std::string>& value,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc));
}

Option Verb::add_option(const std::string& names, std::optional<int>& value,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, value, doc));
}

Option Verb::add_option(const std::string& names, std::vector<std::string>& values,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, values, doc));
}

Option Verb::add_option(const std::string& names, std::vector<int>& values,
                        const std::string& doc) const {
  return Option(*verb_->add_option(names, values, doc));
}

Option Verb::add_option(const std::string& names,
                        const std::function<void(const std::string&)>& function,
                        const std::string& doc) const {
  return Option(*verb_->add_option_function<std::string>(names, function, doc));
}

Option Verb::add_flag(const std::string& names, bool& is_given, const std::string& doc) const {
  return Option(*verb_->add_flag(names, is_given, doc));
}

Option Verb::add_flag(const std::string& names, std::string& value, const std::string& doc) const {
  return Option(*verb_->add_flag(names, value, doc));
}

void Verb::on_call(const std::function<void()>& function) const {
  verb_->callback(function);
}

Parser::Parser(const std::string& doc, const std::string& program)
    : app_(std::make_unique<CLI::App>(doc, program)) {
  app_->require_subcommand(1);
}

Parser::~Parser() = default;

void Parser::set_version(const std::string& version) {
  app_->set_version_flag("--version", version);
}

void Parser::set_footer(const std::string& text) {
  app_->footer(text);
}

Verb Parser::add_verb(const std::string& name) {
  for (const VerbRow& row : minkray::verbs)
    if (row.name == name) return Verb(*app_->add_subcommand(name, std::string(row.doc)));
  throw std::logic_error("no such verb: " + name);
}

std::string Parser::parse(int argc, char** argv) {
  std::ostringstream complaints;
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    app_->exit(error, std::cout, complaints);
  }
  return complaints.str();
}

namespace {

/// What is in braces in a type's name such as "TEXT:{quality,speed}".
std::vector<std::string> choices_in(const std::string& type) {
  std::vector<std::string> choices;
  const std::size_t open = type.find('{'), close = type.rfind('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return choices;
  std::istringstream names(type.substr(open + 1, close - open - 1));
  for (std::string name; std::getline(names, name, ',');) choices.push_back(name);
  return choices;
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
  if (takes_value || description.is_value_optional)
    description.value = description.choices.empty() ? type : type.substr(0, type.find(":{"));
  description.is_required = option.get_required();
  description.is_repeated = option.get_expected_max() > 1;
  description.default_value = option.get_default_str();
  description.doc = option.get_description();
  return description;
}

}  // namespace

std::vector<std::string> Parser::verb_names() const {
  std::vector<std::string> names;
  for (const CLI::App* verb : app_->get_subcommands(nullptr)) names.push_back(verb->get_name());
  return names;
}

std::vector<VerbDescription> Parser::verbs() const {
  std::vector<VerbDescription> verbs;
  for (const CLI::App* verb : app_->get_subcommands(nullptr)) {
    if (verb->get_name().empty()) continue;
    VerbDescription description{verb->get_name(), verb->get_description(), {}};
    for (const CLI::Option* option : verb->get_options(nullptr))
      description.options.push_back(describe(*option));
    verbs.push_back(std::move(description));
  }
  return verbs;
}

}  // namespace minkray
