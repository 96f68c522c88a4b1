// SPDX-License-Identifier: MIT
// Compares a model with MuJoCo: geoms, poses, rays and speed.
#pragma once

#include <cstddef>
#include <string>

namespace minkray {

struct MujocoRow {
  std::string name, refused;
  std::size_t geoms = 0, planes = 0;
  bool same_kinds = true;
  double pose_error = 0;
  int rays = 0, hits = 0, ties = 0, wrong = 0;
  int by_float = 0;    ///< meshes: as MuJoCo's float vertices may differ from the file's
  double worst_t = 0;  ///< of the extent; not of meshes
  double worst_at_mesh = 0;
  double ours = 0, theirs = 0;  ///< seconds for all rays on one thread, the least of the runs

  bool holds() const { return same_kinds && pose_error < 1e-12 && wrong == 0; }
};

MujocoRow beside_mujoco(const std::string& file, int rays, int runs);

}  // namespace minkray
