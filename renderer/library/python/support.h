// SPDX-License-Identifier: MIT
// Support functions written in Python.
#pragma once

#include "renderer/library/python/arrays.h"

namespace minkray_python {

/// A shape of a callable that takes unit directions (M, 3) and answers points (M, 3).
minkray::Shape custom(const py::function& support, const py::object& bounds);

/// True on a thread that is running one.
bool is_in_support();

/// Sets Python's error to the exception that a support function raised to end more than its query,
/// such as SystemExit. Returns false if no such exception was raised.
bool restore_kept();

}  // namespace minkray_python
