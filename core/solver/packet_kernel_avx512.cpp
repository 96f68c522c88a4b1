// SPDX-License-Identifier: MIT
#define MINKRAY_PACKET_KERNEL packet_kernel_avx512
#include "core/solver/packet_kernel.inl"
