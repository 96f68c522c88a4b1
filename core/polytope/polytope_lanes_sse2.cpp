// SPDX-License-Identifier: MIT
#include "core/polytope/polytope_lanes.inl"
