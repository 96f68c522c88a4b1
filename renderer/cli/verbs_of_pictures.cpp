// SPDX-License-Identifier: MIT
// The verbs that the program `minkray` has itself.
#include "renderer/cli/verbs.h"

namespace minkray {
namespace {

struct VerbHere {
  std::string_view name;
  AddVerb add;
};

constexpr VerbHere verbs_here[] = {
    {"render", add_render}, {"merge", add_merge}, {"heatmap", add_heatmap},
    {"import", add_import}, {"info", add_info},
};

}  // namespace

AddVerb verb_here(std::string_view name) {
  for (const VerbHere& verb : verbs_here)
    if (verb.name == name) return verb.add;
  return nullptr;
}

}  // namespace minkray
