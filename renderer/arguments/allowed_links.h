// SPDX-License-Identifier: MIT
// Options of commands that leave out pairs of a robot's links: --srdf and --allow.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "renderer/clearance/allowed_pairs.h"
#include "renderer/cli/options.h"

namespace minkray {

struct AllowedLinks {
  std::string srdf;
  std::vector<std::string> pairs;

  void add_options(const Verb& verb) {
    verb.add_option("--srdf", srdf,
                    "SRDF file (MoveIt); pairs of links that it allows to touch are omitted")
        .reads_file();
    verb.add_option("--allow", pairs,
                    "Omit this pair of links, which are allowed to touch; repeatable\n"
                    "Links connected by a joint are always omitted")
        .takes("LINK,LINK")
        .one_value_each();
  }

  bool any() const { return !srdf.empty() || !pairs.empty(); }

  AllowedPairs read(const Model& model, Mistakes& mistakes) const {
    AllowedPairs allowed;
    if (!srdf.empty()) {
      Mistakes of_file(srdf);
      read_srdf(srdf, model, allowed, of_file);
      throw_if_any(of_file);
    }
    for (const std::string& text : pairs) {
      const std::size_t comma = text.find(',');
      const std::string a = text.substr(0, comma),
                        b = comma == text.npos ? "" : text.substr(comma + 1);
      if (find_link(model, a) >= 0 && find_link(model, b) >= 0)
        allowed.allow(a, b);
      else
        mistakes.add("--allow: must be two links of the robot with a comma between them (got \"" +
                     printable(text, 80) + "\")");
    }
    return allowed;
  }
};

}  // namespace minkray
