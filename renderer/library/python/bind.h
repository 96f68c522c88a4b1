// SPDX-License-Identifier: MIT
// Parts of the extension module.
#pragma once

#include "renderer/library/python/arrays.h"

namespace minkray_python {

void bind_all_hits(py::module_& module);
void bind_shapes(py::module_& module);
void bind_pairs(py::module_& module);
void bind_scene_pairs(py::module_& module);
void bind_scenes(py::module_& module);
void bind_pictures(py::module_& module);

}  // namespace minkray_python
