// SPDX-License-Identifier: MIT
// Support functions written in Python.
#pragma once

#include "renderer/library/python/arrays.h"

namespace minkray_python {

/// A shape of a callable that takes unit directions (M, 3) and answers points (M, 3).
minkray::Shape custom(const py::function& support, const py::object& bounds);

/// True on a thread that is running one.
bool is_in_support();

}  // namespace minkray_python
