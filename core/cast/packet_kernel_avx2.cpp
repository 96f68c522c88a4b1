// SPDX-License-Identifier: MIT
#define MINKRAY_PACKET_KERNEL packet_kernel_avx2
#include "core/cast/packet_kernel.inl"
