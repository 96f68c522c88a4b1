// SPDX-License-Identifier: MIT
#include "renderer/lights/mesh_lamp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace minkray {

MeshLamp::MeshLamp(const PosedMesh& mesh, const std::function<double(std::uint32_t)>& brightness)
    : mesh_(mesh.mesh), pose_(mesh.pose), bounds_(mesh.bounds()), hides_backs_(false) {
  std::vector<LightTree::Light> lights;
  light_of_.resize(mesh_->size(), no_light);
  double area = 0, volume = 0;
  centre_ = bounds_.centre();
  radius_ = bounds_.half_extents().norm();
  for (std::uint32_t part = 0; part < mesh_->size(); ++part) {
    const Vec3<double> a = corner(part, 0), b = corner(part, 1), c = corner(part, 2);
    volume += across(part).dot(a - centre_);
    const double bright = brightness(part), own_area = across(part).norm() / 2;
    if (!(bright > 0) || !(own_area > 0)) continue;
    const Vec3<double> middle = (a + b + c) / 3;
    const double radius = std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
    light_of_[part] = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(part);
    lights.push_back({middle, radius, bright * own_area});
    area += own_area;
    power_ += bright * own_area / (4 * std::numbers::pi);
  }
  size2_ = area / (4 * std::numbers::pi);
  // A closed mesh may be turned inside out, by its vertices or by its pose.
  hides_backs_ = volume != 0 && mesh_->is_closed();
  outwards_ = volume < 0 ? -1 : 1;
  if (!lights.empty()) tree_ = LightTree(lights);
}

Vec3<double> MeshLamp::across(std::uint32_t part) const {
  const Vec3<double> a = corner(part, 0);
  return (corner(part, 1) - a).cross(corner(part, 2) - a);
}

std::optional<MeshLamp::Sample> MeshLamp::sample(const Vec3<double>& point, double which,
                                                 const std::array<double, 2>& u) const {
  const std::uint32_t part = triangles_[tree_.choose(point, which)];
  const double root = std::sqrt(u[0]);
  const Vec3<double> at = (1 - root) * corner(part, 0) + root * (1 - u[1]) * corner(part, 1) +
                          root * u[1] * corner(part, 2);
  const Vec3<double> way = at - point;
  const double distance = way.norm();
  if (!(distance > 0)) return std::nullopt;
  return Sample{way / distance, distance, part};
}

double MeshLamp::pdf(const Vec3<double>& point, const Vec3<double>& direction, std::uint32_t part,
                     double t) const {
  if (part >= light_of_.size() || light_of_[part] == no_light) return 0;
  // Rays from outside of a closed mesh meet no triangle from behind.
  const bool is_outside = hides_backs_ && ((point.array() < bounds_.lower.array()).any() ||
                                           (point.array() > bounds_.upper.array()).any());
  const double fall = direction.dot(across(part));
  if (is_outside && fall * outwards_ > 0) return 0;
  // The triangle's area as it is seen, over the squared distance, is its solid angle.
  const double seen = std::abs(fall) / 2;
  return seen > 0 ? tree_.chance(point, light_of_[part]) * t * t / seen : 0;
}

}  // namespace minkray
