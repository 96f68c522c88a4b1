// SPDX-License-Identifier: MIT
// The command line as data, read off the parser itself: what man pages and completions are made of.
#pragma once

#include <string>
#include <vector>

namespace minkray {

struct OptionDescription {
  std::vector<std::string> flags;  ///< "-o", "--output"; empty: given by its place
  std::string place;               ///< the name of what is given by its place, else empty
  std::string value;               ///< what it takes, such as "FILE" or "N"; "": nothing
  std::string range;               ///< "0 to 64"; empty: any
  std::string group;               ///< the heading in help that it stands under
  bool is_value_optional = false;  ///< "--stats" or "--stats=json"
  bool is_required = false;
  bool is_repeated = false;
  std::vector<std::string> choices;  ///< the values there are, if they are few
  std::string default_value;
  std::string doc;
};

/// The heading of what few people need for a picture.
inline constexpr const char* research_group = "Research";

/// What an option does, with its range and default.
std::string whole_doc(const OptionDescription& option);

struct VerbDescription {
  std::string name;
  std::string doc;
  std::vector<std::string> examples;
  std::vector<OptionDescription> options;  ///< in the order of --help
};

}  // namespace minkray
