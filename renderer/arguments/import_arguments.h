// SPDX-License-Identifier: MIT
// Options shared by the commands that take a scene: conversion of a robot's file to a scene.
#pragma once

#include <string>

#include "renderer/import/model/import_options.h"

namespace minkray {

class Option;
class Verb;

/// Help text of the scene argument.
std::string scene_argument();

/// Adds files after the first one, which become part of the same scene.
void add_other_files(const Verb& verb, ImportOptions& options);

/// Adds the options; the geometry in `options` is the default. `rows`: true if a file of joint
/// values is one of the options. Returns --verbose.
Option add_import_options(const Verb& verb, ImportOptions& options, bool rows = true);

}  // namespace minkray
