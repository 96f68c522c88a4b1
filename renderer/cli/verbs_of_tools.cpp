// SPDX-License-Identifier: MIT
// All commands: the source of completions and man pages.
#include "renderer/cli/verbs.h"

namespace minkray {
namespace {

constexpr VerbHere here[] = {
    {"render", add_render},
    {"merge", add_merge},
    {"heatmap", add_heatmap},
    {"inspect", add_inspect},
    {"compare", add_compare},
    {"cast", add_cast},
    {"scan", add_scan},
    {"distance", add_distance},
    {"clearance", add_clearance},
    {"verify", add_verify},
    {"field", add_field},
    {"trace", add_trace},
    {"paper", add_paper},
    {"distance-2d", add_distance_2d},
    {"generate", add_generate},
    {"import", add_import},
    {"info", add_info},
    {"league", add_league},
    {"completion", add_completion},
    {"man", add_man},
};

}  // namespace

std::span<const VerbHere> verbs_here() {
  return here;
}

}  // namespace minkray
