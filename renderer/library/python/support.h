// SPDX-License-Identifier: MIT
// Support functions that are written in Python.
#pragma once

#include <string>

#include "renderer/library/python/arrays.h"

namespace minkray_python {

/// A shape of a callable that takes unit directions (M, 3) and answers points (M, 3).
minkray::Shape custom(const py::function& support, const py::object& bounds);

/// What the last support function that failed raised, which is forgotten by asking; the
/// interpreter's lock must be held.
std::string raised_by_support();

}  // namespace minkray_python
