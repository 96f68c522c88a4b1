// SPDX-License-Identifier: MIT
#define MINKRAY_NEAREST_FEATURES nearest_features_sse2
#include "core/parts/nearest_features.inl"
