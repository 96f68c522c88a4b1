// SPDX-License-Identifier: MIT
// Command line as data, read from the parser: the source of man pages and completions.
#pragma once

#include <string>
#include <vector>

namespace minkray {

struct OptionDescription {
  std::vector<std::string> flags;  ///< "-o", "--output"; empty: positional argument
  std::string place;               ///< name of a positional argument, otherwise empty
  std::string value;               ///< kind of value, such as "FILE" or "N"; "": none
  std::string range;               ///< "0 to 64"; empty: any
  std::string group;               ///< heading in help
  bool is_value_optional = false;  ///< "--stats" or "--stats=json"
  bool is_required = false;
  bool is_repeated = false;
  std::vector<std::string> choices;  ///< allowed values, if they are few
  std::string default_value;
  std::string doc;
};

/// Heading for options that few users need for a picture.
inline constexpr const char* research_group = "Research";

/// Help of an option, with its range and default.
std::string whole_doc(const OptionDescription& option);

struct VerbDescription {
  std::string name;
  std::string doc;
  std::vector<std::string> examples;
  std::vector<OptionDescription> options;  ///< in the order of --help
  std::string exit_codes = {};             ///< empty: those of minkray --help
};

}  // namespace minkray
