// SPDX-License-Identifier: MIT
// Public C++ header, the only one that the Python module includes.
#pragma once

#include <minkray/minkray.h>
