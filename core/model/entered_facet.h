// SPDX-License-Identifier: MIT
// Finds where a line enters a polytope with stored facets, for every kind of polytope: between its
// slabs, or by walking from triangle to triangle.
#pragma once

#include "core/model/entered_slab.h"
#include "core/model/entered_triangle.h"
