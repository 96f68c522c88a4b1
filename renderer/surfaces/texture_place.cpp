// SPDX-License-Identifier: MIT
#include "renderer/surfaces/texture_place.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace minkray {
namespace {

using std::numbers::pi;

/// Depth below the surface at which textures in space are evaluated, in repeats: a face that lies
/// just where two fields meet is not speckled by rounding.
constexpr double below_surface = 1e-6;

/// The two coordinates of a vector other than the axis of x, y or z that the surface faces most;
/// upright sides have z downwards.
Vec3<double> on_box(const Vec3<double>& p, const Vec3<double>& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const double side = normal[axis] < 0 ? -1 : 1;
  if (axis == 0) return {side * p.y(), -p.z(), 0};
  if (axis == 1) return {-side * p.x(), -p.z(), 0};
  return {p.x(), -side * p.y(), 0};
}

/// Change of longitude and latitude with a direction, to first order. At the poles it is a whole
/// turn.
Vec3<double> radial_change(const Vec3<double>& direction, const Vec3<double>& change) {
  const double around = std::hypot(direction.x(), direction.y());
  const double length = std::hypot(around, direction.z());
  const auto of_turn = [](double across, double radius) {
    return std::abs(across) < radius ? across / radius : std::copysign(across == 0 ? 0 : 1, across);
  };
  if (!(length > 0)) return Vec3<double>::Zero();
  const Vec3<double> level = around > 0
                                 ? Vec3<double>(direction.x() / around, direction.y() / around, 0)
                                 : Vec3<double>::UnitX();
  const double east = level.x() * change.y() - level.y() * change.x();
  const double outwards = level.dot(change);
  const double down = (direction.z() * outwards - around * change.z()) / length;
  return {of_turn(east, 2 * pi * around), of_turn(down, pi * length), 0};
}

/// Change of the normal across a side of the footprint: as on a ball around the object's origin
/// that touches the surface there.
Vec3<double> normal_change(const TexturePoint& at, const Vec3<double>& side) {
  const double radius = at.position.dot(at.normal);
  return radius > 0 ? Vec3<double>(side / radius) : Vec3<double>::Zero();
}

/// Direction in which u grows and v does not.
Vec3<double> right_by_uv(const TexturePoint& at) {
  const Vec3<double>&u = at.uv_slopes[0], &v = at.uv_slopes[1];
  const double square = v.squaredNorm();
  const Vec3<double> right = square > 0 ? Vec3<double>(u - u.dot(v) / square * v) : u;
  return right.isZero(0) ? u : right;
}

}  // namespace

TexturePlace texture_place(const TexturePoint& at, const Mapping& mapping, double scale) {
  const auto place = [&](const Vec3<double>& middle, const auto& of_side) -> TexturePlace {
    return {middle / scale, {of_side(at.footprint[0]) / scale, of_side(at.footprint[1]) / scale}};
  };
  if (mapping.name == "radial")
    return place(radial_place(at.position),
                 [&](const Vec3<double>& side) { return radial_change(at.position, side); });
  if (mapping.name == "normal")
    return place(radial_place(at.normal), [&](const Vec3<double>& side) {
      return radial_change(at.normal, normal_change(at, side));
    });
  if (mapping.name == "uv")
    return place(at.uv, [&](const Vec3<double>& side) { return at.uv_change(side); });
  if (mapping.name == "box") {
    const auto on_plane = [&](const Vec3<double>& p) { return on_box(p, at.normal); };
    return place(on_plane(at.position), on_plane);
  }
  if (mapping.name == "planar") {
    const auto on_plane = [](const Vec3<double>& p) { return Vec3<double>(p.x(), -p.y(), 0); };
    return place(on_plane(at.position), on_plane);
  }
  TexturePlace in_space = place(at.position, [](const Vec3<double>& side) { return side; });
  in_space.middle -= below_surface * at.normal;
  return in_space;
}

Vec3<double> radial_place(const Vec3<double>& direction) {
  const double length = direction.norm();
  if (!(length > 0)) return Vec3<double>::Zero();
  return {0.5 + std::atan2(direction.y(), direction.x()) / (2 * pi),
          std::acos(std::clamp(direction.z() / length, -1.0, 1.0)) / pi, 0};
}

Vec3<double> picture_right(const TexturePoint& at, const Mapping& mapping) {
  if (mapping.name == "box") {
    int axis = 0;
    at.normal.cwiseAbs().maxCoeff(&axis);
    const double side = at.normal[axis] < 0 ? -1 : 1;
    if (axis == 0) return {0, side, 0};
    if (axis == 1) return {-side, 0, 0};
    return Vec3<double>::UnitX();
  }
  if (mapping.name == "planar") return Vec3<double>::UnitX();
  if (mapping.name == "uv" && !at.uv_slopes[0].isZero(0)) return right_by_uv(at);
  const Vec3<double>& outwards = mapping.name == "normal" ? at.normal : at.position;
  const Vec3<double> around(-outwards.y(), outwards.x(), 0);
  return around.isZero(0) ? Vec3<double>(Vec3<double>::UnitY()) : around;
}

}  // namespace minkray
