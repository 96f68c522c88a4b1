// SPDX-License-Identifier: MIT
#include "core/parts/box_gaps.h"

#include "core/math/instruction_set.h"

namespace minkray {

void box_gaps(const EightBoxes& boxes, const MiddleBox& other, const Turned& at,
              const KnownDirection* known, double* gaps) {
  (has_avx2() ? box_gaps_avx2 : box_gaps_sse2)(boxes, other, at, known, gaps);
}

}  // namespace minkray
