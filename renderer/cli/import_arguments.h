// SPDX-License-Identifier: MIT
// What all verbs take that take a scene: how a robot's file is made one.
#pragma once

#include <string>

#include "renderer/import/import_options.h"

namespace minkray {

class Option;
class Verb;

/// The help of the argument itself.
std::string scene_argument();

/// Adds files behind the first one, which stand in the same scene.
void add_other_files(const Verb& verb, ImportOptions& options);

/// The geometry that `options` has is the default. `rows`: whether a file of joints' values is one
/// of them. Returns --verbose.
Option add_import_options(const Verb& verb, ImportOptions& options, bool rows = true);

}  // namespace minkray
