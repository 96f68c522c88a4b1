// SPDX-License-Identifier: MIT
// The public C++ header: all that the Python module sees of Minkray.
#pragma once

#include <minkray/minkray.h>
