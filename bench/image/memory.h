// SPDX-License-Identifier: MIT
// Memory where no two objects have the same shape: exact shapes compared with triangles of equal
// error.
#pragma once

#include <cstddef>

namespace minkray::bench {

struct MemoryOfUnshared {
  double our_bytes = 0;       ///< an object
  double our_heap_bytes = 0;  ///< by what the process had allocated before and after
  double triangle_bytes = 0;
  double triangles = 0;  ///< an object
};

/// Rounded boxes of random sizes. All meshes have about the same size, so a few suffice.
MemoryOfUnshared measure_memory(std::size_t exact_objects, std::size_t meshes,
                                double relative_error);

}  // namespace minkray::bench
