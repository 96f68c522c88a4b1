// SPDX-License-Identifier: MIT
#include "core/derived/ellipsoid_sum.h"

namespace minkray {}  // namespace minkray
