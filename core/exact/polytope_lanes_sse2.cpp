// SPDX-License-Identifier: MIT
#include "core/exact/polytope_lanes.inl"
