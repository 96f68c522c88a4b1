// SPDX-License-Identifier: MIT
#define MINKRAY_PLANE_SCAN scan_planes_avx2
#include "core/exact/plane_scan.inl"
