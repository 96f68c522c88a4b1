// SPDX-License-Identifier: MIT
// Finds where a line enters a polytope with stored facets. For boxes, tests the slabs; for hulls,
// walks from triangle to triangle.
#pragma once

#include "core/model/entered_slab.h"
#include "core/model/entered_triangle.h"
