// SPDX-License-Identifier: MIT
// Materials of several scenes in one list.
#pragma once

#include "renderer/scene/scene.h"

namespace minkray {

/// Moves the materials of `from` to the end of the list of `to`, with their keys. Objects and
/// particles of `from` then refer to that list.
void append_materials(Scene& to, Scene& from);

/// Adds primes (') to names that an earlier material has: scene files refer to materials by name.
void make_names_unique(Scene& scene);

}  // namespace minkray
