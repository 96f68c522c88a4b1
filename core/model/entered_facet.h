// SPDX-License-Identifier: MIT
// Where a line enters a polytope that knows its facets, for every kind of polytope that there is:
// between its slabs, or by walking from triangle to triangle.
#pragma once

#include "core/model/entered_slab.h"
#include "core/model/entered_triangle.h"
