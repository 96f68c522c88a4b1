// SPDX-License-Identifier: MIT
#define MINKRAY_WALK_KERNEL walk_sse2
#include "core/bvh/traverse_kernel.inl"
