// SPDX-License-Identifier: MIT
#include "core/parts/box_gaps.h"

namespace minkray {

void box_gaps(const EightBoxes& boxes, const MiddleBox& other, const Turned& at,
              const KnownDirection* known, double* gaps) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx2")) return box_gaps_avx2(boxes, other, at, known, gaps);
#endif
  box_gaps_sse2(boxes, other, at, known, gaps);
}

}  // namespace minkray
