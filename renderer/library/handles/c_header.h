// SPDX-License-Identifier: MIT
// The public header, as the library's own sources see it.
#pragma once

#include <minkray/minkray_c.h>
