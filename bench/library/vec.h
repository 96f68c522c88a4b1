// SPDX-License-Identifier: MIT
// Vectors and rotations, as a user without a linear algebra library writes them.
#pragma once

#include <minkray/minkray.h>

#include <cmath>

namespace bench {

namespace mk = minkray;

struct Vec {
  double x = 0, y = 0, z = 0;

  Vec() = default;
  Vec(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  Vec(const mk::Vec3& v) : x(v.x), y(v.y), z(v.z) {}
  operator mk::Vec3() const { return {x, y, z}; }

  friend Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec operator*(double s, const Vec& v) { return {s * v.x, s * v.y, s * v.z}; }
};

inline double dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec& v) {
  return std::sqrt(dot(v, v));
}
inline Vec normalized(const Vec& v) {
  return (1 / norm(v)) * v;
}
/// Product entry by entry.
inline Vec scaled(const Vec& a, const Vec& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
/// The place of a point under a pose.
inline Vec at(const mk::Pose& pose, const Vec& p) {
  const auto row = [&](int i) {
    return dot(Vec(pose.rows[i][0], pose.rows[i][1], pose.rows[i][2]), p) + pose.rows[i][3];
  };
  return {row(0), row(1), row(2)};
}

}  // namespace bench
