// SPDX-License-Identifier: MIT
#define MINKRAY_TRIANGLE_GAPS triangle_gaps_sse2
#define MINKRAY_TRIANGLE_NORMALS triangle_normals_sse2
#include "core/parts/triangle_lanes.inl"
