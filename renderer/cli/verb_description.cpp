// SPDX-License-Identifier: MIT
#include "renderer/cli/verb_description.h"

#include <CLI/CLI.hpp>
#include <sstream>

namespace minkray {
namespace {

/// Of a type's name such as "TEXT:{quality,speed}" what is in braces.
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

std::vector<VerbDescription> describe_verbs(const CLI::App& app) {
  std::vector<VerbDescription> verbs;
  for (const CLI::App* verb : app.get_subcommands(nullptr)) {
    if (verb->get_name().empty()) continue;
    VerbDescription description{verb->get_name(), verb->get_description(), {}};
    for (const CLI::Option* option : verb->get_options(nullptr))
      description.options.push_back(describe(*option));
    verbs.push_back(std::move(description));
  }
  return verbs;
}

}  // namespace minkray
