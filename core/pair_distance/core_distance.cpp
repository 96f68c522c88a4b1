// SPDX-License-Identifier: MIT
#include "core/pair_distance/core_distance.h"

#include "core/pair/core_kinds.h"
#include "core/pair_distance/curved_gjk.h"

namespace minkray {

CoreDistance distance_of_cores(const CorePair& pair, const CoreSearch& search,
                               Enclosure* enclosure) {
  return with_core_kinds(pair, [&]<CoreKind A, CoreKind B>() {
    CurvedGjk<A, B> gjk(pair, search);
    const CoreDistance found = gjk.run();
    if (search.memory && !found.axis.isZero(0)) search.memory->axis = found.axis;
    if (enclosure) enclosure->is_found = gjk.encloses(enclosure->c.data(), enclosure->a.data());
    return found;
  });
}

}  // namespace minkray
