// SPDX-License-Identifier: MIT
// The command line as data, read off the parser itself: what man pages and completions are made of.
#pragma once

#include <string>
#include <vector>

namespace minkray {

struct OptionDescription {
  std::vector<std::string> flags;  ///< "-o", "--output"; empty: given by its place
  std::string place;               ///< the name of what is given by its place, else empty
  std::string value;  ///< what it takes, such as "FILE" or "INT in [0 - 64]"; "": nothing
  bool is_value_optional = false;  ///< "--stats" or "--stats=json"
  bool is_required = false;
  bool is_repeated = false;
  std::vector<std::string> choices;  ///< the values there are, if they are few
  std::string default_value;
  std::string doc;
};

struct VerbDescription {
  std::string name;
  std::string doc;
  std::vector<OptionDescription> options;  ///< in the order of --help
};

}  // namespace minkray
