// SPDX-License-Identifier: MIT
// MuJoCo's own reading of its models: geoms where its kinematics put them, and its rays.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/math/affine.h"
#include "core/math/ray.h"

namespace minkray::testing {

class MujocoModel {
 public:
  /// Null if MuJoCo rejects the file; `why` gets its message.
  static std::unique_ptr<MujocoModel> load(const std::string& file, std::string& why);
  ~MujocoModel();

  struct Geom {
    std::string kind;  ///< in MJCF's words
    Vec3<double> size;
    Affine<double> pose;                 ///< in the world
    std::vector<Vec3<double>> vertices;  ///< of meshes: in the geom's frame
    std::string name;
  };
  std::vector<Geom> geoms() const;

  /// Sets the joints to these numbers, all of them in MuJoCo's order; empty: as the file has them.
  void set_positions(const std::vector<double>& qpos);
  std::size_t positions() const;
  std::size_t bodies() const;
  std::vector<double> keyframe(std::size_t i) const;
  std::size_t keyframes() const;

  /// Parameter at which a ray first meets a geom from outside, by mj_ray; infinite if it meets
  /// none.
  double ray(const Ray<double>& ray, int& geom) const;

 private:
  struct Parts;
  explicit MujocoModel(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace minkray::testing
