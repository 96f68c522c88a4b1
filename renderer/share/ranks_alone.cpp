// SPDX-License-Identifier: MIT
#include <cstdlib>

#include "renderer/base/errors.h"
#include "renderer/share/ranks.h"

namespace minkray {

const bool has_mpi = false;

Ranks::Ranks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* size = std::getenv(name); size != nullptr && std::atoi(size) > 1)
      throw WrongUsage(
          "this minkray was built without MPI: install libopenmpi-dev and build again with "
          "-DMINKRAY_MPI=ON, or render with --tile");
}

Ranks::~Ranks() = default;

void Ranks::send(int, int) {}

std::optional<RankMessage> Ranks::poll() {
  return std::nullopt;
}

}  // namespace minkray
