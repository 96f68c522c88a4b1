// SPDX-License-Identifier: MIT
#define MINKRAY_PLANE_SCAN scan_planes_sse2
#include "core/polytope/plane_scan.inl"
