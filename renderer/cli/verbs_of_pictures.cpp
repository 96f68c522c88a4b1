// SPDX-License-Identifier: MIT
// Commands of the program `minkray` itself.
#include "renderer/cli/verbs.h"

namespace minkray {
namespace {

constexpr VerbHere here[] = {
    {"render", add_render}, {"merge", add_merge}, {"heatmap", add_heatmap},
    {"import", add_import}, {"info", add_info},
};

}  // namespace

std::span<const VerbHere> verbs_here() {
  return here;
}

}  // namespace minkray
