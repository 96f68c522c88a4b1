// SPDX-License-Identifier: MIT
#include <mpi.h>

#include <cstdlib>
#include <exception>

#include "renderer/share/ranks.h"

namespace minkray {
namespace {

constexpr int tag = 1;

/// Without a launcher MPI_Init would start a daemon of its own, and take its time.
bool was_launched() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_SIZE"})
    if (std::getenv(name) != nullptr) return true;
  return false;
}

bool is_running() {
  int is_initialised = 0, is_finalised = 0;
  MPI_Initialized(&is_initialised);
  MPI_Finalized(&is_finalised);
  return is_initialised && !is_finalised;
}

}  // namespace

const bool has_mpi = true;

Ranks::Ranks() : exceptions_(std::uncaught_exceptions()) {
  if (!was_launched()) return;
  int provided = 0;
  // On rank 0 a thread of its own hands out the tiles; no two threads call MPI at once.
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
}

Ranks::~Ranks() {
  if (is_running() && std::uncaught_exceptions() == exceptions_) MPI_Finalize();
}

void Ranks::send(int to, int number) {
  MPI_Send(&number, 1, MPI_INT, to, tag, MPI_COMM_WORLD);
}

std::optional<RankMessage> Ranks::poll() {
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &is_there, &status);
  if (!is_there) return std::nullopt;
  RankMessage message{status.MPI_SOURCE, 0};
  MPI_Recv(&message.number, 1, MPI_INT, message.from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return message;
}

}  // namespace minkray
