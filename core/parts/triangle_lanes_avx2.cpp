// SPDX-License-Identifier: MIT
#define MINKRAY_TRIANGLE_GAPS triangle_gaps_avx2
#define MINKRAY_TRIANGLE_NORMALS triangle_normals_avx2
#include "core/parts/triangle_lanes.inl"
