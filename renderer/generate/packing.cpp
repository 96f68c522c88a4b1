// SPDX-License-Identifier: MIT
#include "renderer/generate/packing.h"

#include <stdexcept>
#include <unordered_map>

#include "renderer/paper/distance.h"

namespace minkray {
namespace {

/// Places tried per ellipsoid. At a sixth of the volume about half of them are free, so this many
/// failures mean that there is no room.
constexpr int most_tries = 100000;

Affine<double> pose_of(const PackedPose& pose) {
  const auto& q = pose.rotation;
  return {rotation_matrix_of_any(q[0], q[1], q[2], q[3]), pose.position};
}

/// Ellipsoids placed so far, by the cells of a grid; those that touch are in neighbouring cells.
class Packing {
 public:
  explicit Packing(const Vec3<double>& radii)
      : shape_(Ellipsoid{radii}), least_radius_(radii.minCoeff()), cell_(2 * radii.maxCoeff()) {}

  bool has_room_for(const PackedPose& pose) const {
    const CentredShape shape = centred(shape_, pose_of(pose));
    const auto cell = cell_of(pose.position);
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto at = first_.find(key({cell[0] + x, cell[1] + y, cell[2] + z}));
          if (at == first_.end()) continue;
          for (std::size_t i = at->second; i != none; i = next_[i])
            if (meets(pose, shape, poses[i])) return false;
        }
    return true;
  }

  void add(const PackedPose& pose) {
    const auto [at, is_new] = first_.try_emplace(key(cell_of(pose.position)), none);
    next_.push_back(at->second);
    at->second = poses.size();
    poses.push_back(pose);
  }

  std::vector<PackedPose> poses;

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  using Cell = std::array<std::int64_t, 3>;

  Cell cell_of(const Vec3<double>& position) const {
    Cell cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] =
          static_cast<std::int64_t>(std::floor(position[axis] / cell_));
    return cell;
  }
  /// Cells are a few thousand at most in each direction.
  static std::uint64_t key(const Cell& cell) {
    std::uint64_t key = 0;
    for (const std::int64_t index : cell)
      key = key << 21 | (static_cast<std::uint64_t>(index + (1 << 20)) & 0x1fffff);
    return key;
  }

  bool meets(const PackedPose& a, const CentredShape& shape, const PackedPose& b) const {
    const double distance = (a.position - b.position).norm();
    if (distance >= cell_) return false;
    if (distance <= 2 * least_radius_) return true;
    // Exhausted counts as meeting.
    return distance_between(shape, centred(shape_, pose_of(b))).status != DistanceStatus::separated;
  }

  Shape shape_;
  double least_radius_, cell_;
  std::unordered_map<std::uint64_t, std::size_t> first_;
  std::vector<std::size_t> next_;
};

double as_float(double value) {
  return static_cast<double>(static_cast<float>(value));
}

}  // namespace

std::vector<PackedPose> pack_ellipsoids(std::size_t count, const Vec3<double>& radii,
                                        double half_size, Random& random) {
  Packing packing(radii);
  packing.poses.reserve(count);
  while (packing.poses.size() < count) {
    for (int tries = 0;; ++tries) {
      if (tries == most_tries)
        throw std::runtime_error("no room for ellipsoid " + std::to_string(packing.poses.size()));
      PackedPose pose{random.in_cube(half_size), random.rotation()};
      pose.position = pose.position.unaryExpr(&as_float);
      for (double& entry : pose.rotation) entry = as_float(entry);
      if (!packing.has_room_for(pose)) continue;
      packing.add(pose);
      break;
    }
  }
  return std::move(packing.poses);
}

}  // namespace minkray
