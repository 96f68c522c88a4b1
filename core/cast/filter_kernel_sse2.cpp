// SPDX-License-Identifier: MIT
#define MINKRAY_FILTER_KERNEL filter_kernel_sse2
#include "core/cast/filter_kernel.inl"
