// SPDX-License-Identifier: MIT
// Arguments for calls: mostly such as can be, some that cannot.
#include <array>
#include <limits>

#include "tests/fuzz/c_abi_program.h"
#include "tests/fuzz/shape_from_bytes.h"

namespace minkray::fuzz {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

/// A number of any size in a wild program, and in any program possibly not finite.
double CallProgram::number() {
  static constexpr std::array odd = {nan, infinity, -infinity, 1e308, -1e308, 5e-324, 0.0, -0.0};
  if (hostile()) return odd[static_cast<std::size_t>(bytes_.below(odd.size()))];
  return bytes_.coordinate<double>(wild_);
}

void CallProgram::hold(minkray_shape made, bool is_custom) {
  for (const HeldShape& other : shapes_)
    promises_.expect(other.shape.id != made.id, "a handle that was given out before");
  promises_.expect(made.id != 0, "a handle that is none");
  shapes_.push_back({made, 1, is_custom});
}

Given<minkray_shape> CallProgram::shape() {
  if (hostile() || shapes_.empty()) {
    static constexpr std::array<std::uint64_t, 4> odd = {0, 1, 0xffffffffffffffff,
                                                         0x0100000100000001};
    const minkray_shape none = {odd[static_cast<std::size_t>(bytes_.below(3))]};
    if (!scenes_.empty() && bytes_.below(2) == 1) return {{scenes_.back().scene.id}, Sure::wrong};
    return {none, Sure::wrong};
  }
  const HeldShape& held = shapes_[bytes_.byte() % shapes_.size()];
  return {held.shape, right_if(held.owners > 0)};
}

Given<minkray_scene> CallProgram::scene() {
  if (hostile() || scenes_.empty()) {
    if (!shapes_.empty() && bytes_.below(2) == 1) return {{shapes_.back().shape.id}, Sure::wrong};
    return {{static_cast<std::uint64_t>(bytes_.below(3))}, Sure::wrong};
  }
  const HeldScene& held = scenes_[bytes_.byte() % scenes_.size()];
  return {held.scene, right_if(held.is_held)};
}

CallProgram::HeldScene* CallProgram::model_of(minkray_scene scene) {
  for (HeldScene& held : scenes_)
    if (held.scene.id == scene.id && held.is_held) return &held;
  return nullptr;
}

Given<const minkray_pose*> CallProgram::pose(bool required) {
  minkray_pose& pose = pose_[next_pose_ ^= 1];
  if (bytes_.below(3) == 0) return {nullptr, right_if(!required)};
  const Affine<double> map = map_from(bytes_, wild_);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.rows[i][j] = map.linear(i, j);
    pose.rows[i][3] = map.translation[i];
  }
  if (!hostile()) return {&pose, wild_ ? Sure::either : Sure::right};
  static constexpr std::array odd = {nan, infinity, -infinity};
  double& changed = pose.rows[bytes_.below(3)][bytes_.below(4)];
  if (bytes_.below(2) == 0) {
    changed = odd[static_cast<std::size_t>(bytes_.below(odd.size()))];
    return {&pose, Sure::wrong};
  }
  for (double& number : pose.rows[bytes_.below(3)]) number = 0;
  return {&pose, Sure::wrong};
}

Given<const minkray_options*> CallProgram::options() {
  if (!hostile()) {
    if (bytes_.below(2) == 0) return {nullptr};
    options_ = {sizeof options_, 1 + bytes_.below(3), 0, nullptr, nullptr};
    return {&options_};
  }
  options_ = {sizeof options_, 1, 0, nullptr, nullptr};
  if (bytes_.below(2) == 0)
    options_.size = static_cast<std::size_t>(bytes_.below(sizeof options_));
  else
    options_.threads = bytes_.below(2) == 0 ? -1 - bytes_.below(3) : 1025 + bytes_.below(3);
  return {&options_, Sure::wrong};
}

Given<std::vector<minkray_ray>> CallProgram::rays() {
  Given<std::vector<minkray_ray>> given;
  // Now and then more than one solver's group of them.
  const int count = bytes_.below(16) == 0 ? 40 : bytes_.below(9);
  for (int i = 0; i < count; ++i) {
    const Vec3<double> origin = bytes_.point<double>(wild_);
    // Towards the origin's neighbourhood, where things are.
    Vec3<double> direction = bytes_.point<double>(false) / 4 - origin;
    if (!(direction.cwiseAbs().maxCoeff() > 0)) direction.x() = 1;
    minkray_ray ray = {{origin.x(), origin.y(), origin.z()},
                       {direction.x(), direction.y(), direction.z()},
                       infinity};
    const unsigned end = bytes_.byte();
    if (end < 32) ray.t_max = bytes_.positive<double>(wild_);
    if (end >= 252) {
      static constexpr std::array odd = {nan, infinity, -infinity};
      const int at = bytes_.below(7);
      double& changed = at < 3 ? ray.origin[at] : at < 6 ? ray.direction[at - 3] : ray.t_max;
      changed = at == 6 ? -1.0 : odd[static_cast<std::size_t>(bytes_.below(odd.size()))];
      given.sure = Sure::wrong;
    }
    given.value.push_back(ray);
  }
  return given;
}

}  // namespace minkray::fuzz
