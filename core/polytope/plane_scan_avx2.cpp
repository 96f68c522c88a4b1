// SPDX-License-Identifier: MIT
#define MINKRAY_PLANE_SCAN scan_planes_avx2
#include "core/polytope/plane_scan.inl"
