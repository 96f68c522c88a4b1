// SPDX-License-Identifier: MIT
// All parts of the table. Each runs in a process of its own.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "table.h"

namespace bench {

struct Options {
  int rounds = 5;
  int side = 512;              ///< of the camera's picture, in pixels
  std::size_t queries = 1000;  ///< of a pair of shapes
  std::string python;          ///< the interpreter, which finds the module; empty: no such rows
};

struct Section {
  std::string name;
  std::function<void(Table&, const Options&)> run;
};

std::vector<Section> all_sections();

// One file each.
std::vector<Section> scene_sections();
std::vector<Section> shape_sections();
std::vector<Section> distance_sections();
std::vector<Section> impact_sections();
std::vector<Section> batch_sections();
std::vector<Section> mesh_sections();
std::vector<Section> python_sections();
std::vector<Section> memory_sections();

}  // namespace bench
