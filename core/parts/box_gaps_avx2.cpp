// SPDX-License-Identifier: MIT
#define MINKRAY_BOX_GAPS box_gaps_avx2
#include "core/parts/box_gaps.inl"
