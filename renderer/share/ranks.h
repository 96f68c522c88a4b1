// SPDX-License-Identifier: MIT
// Processes of an MPI job. Only ranks_mpi.cpp includes MPI. Without MPI (MINKRAY_MPI=OFF),
// ranks_alone.cpp replaces it, with one rank.
#pragma once

#include <optional>

namespace minkray {

/// A number that a rank sent.
struct RankMessage {
  int from = 0;
  int number = 0;
};

/// There may be one at a time. MPI is only started where a launcher such as mpirun started the
/// process. Only one thread at a time may use it.
class Ranks {
 public:
  /// Throws WrongUsage if there are several ranks but this program was built without MPI: each
  /// would render the whole picture.
  Ranks();
  /// Waits until all ranks are here; not if an exception is under way, which ends the whole job.
  ~Ranks();  // NOLINT(performance-trivially-destructible): MPI's waits
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  int rank() const { return rank_; }
  int count() const { return count_; }

  void send(int to, int number);
  /// Does not wait; nothing if there is none.
  std::optional<RankMessage> poll();

 private:
  int rank_ = 0;
  int count_ = 1;
  [[maybe_unused]] int exceptions_ = 0;  ///< those under way when this was made
};

/// True if this program was built with MPI.
extern const bool has_mpi;

}  // namespace minkray
