// SPDX-License-Identifier: MIT
#include "renderer/library/handles/bodies_of_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/mesh/mapped.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/poses.h"

namespace minkray {
namespace {

/// Tolerated deviation of a linear part from a rotation: more is a mistake, not rounding.
constexpr double most_off_rigid = 1e-6;

constexpr std::size_t numbers_of_quaternion_pose = 7;

/// Bytes of one pose; 0 if there is no such kind.
std::size_t size_of_pose(int kind) {
  switch (kind) {
    case MINKRAY_POSE_MATRIX:
      return 12 * sizeof(double);
    case MINKRAY_POSE_QUATERNION:
      return numbers_of_quaternion_pose * sizeof(double);
    case MINKRAY_POSE_MATRIX_4X4:
      return 16 * sizeof(double);
    default:
      return 0;
  }
}

void check_count(std::size_t have, std::size_t pairs, const std::string& argument) {
  if (have == pairs || have == 1) return;
  wrong_use(argument + ": must be one, or as many as pairs, " + std::to_string(pairs) + " (got " +
            std::to_string(have) + ")");
}

std::string place(const std::string& argument, const char* member, std::size_t i) {
  return argument + member + "[" + std::to_string(i) + "]";
}

/// The pose of (x, y, z, qw, qx, qy, qz).
Affine<double> pose_at(const double* numbers, const std::string& argument, std::size_t index) {
  for (std::size_t k = 0; k < numbers_of_quaternion_pose; ++k)
    if (!std::isfinite(numbers[k])) [[unlikely]]
      wrong_use(place(argument, ".poses", index) + "[" + std::to_string(k) +
                "]: must be a finite number (got " + std::to_string(numbers[k]) + ")");
  const double largest = std::max(
      {std::abs(numbers[3]), std::abs(numbers[4]), std::abs(numbers[5]), std::abs(numbers[6])});
  if (!(largest > 0))
    wrong_use(place(argument, ".poses", index) + ": must have a quaternion that is not zero");
  Eigen::Quaternion<double> q(numbers[3] / largest, numbers[4] / largest, numbers[5] / largest,
                              numbers[6] / largest);
  q.normalize();
  return {q.toRotationMatrix(), Vec3<double>(numbers[0], numbers[1], numbers[2])};
}

inline void check_last_row(const double* row, const std::string& argument, std::size_t index) {
  if (row[0] != 0 || row[1] != 0 || row[2] != 0 || row[3] != 1) [[unlikely]]
    wrong_use(place(argument, ".poses", index) + ": the last row must be (0, 0, 0, 1)");
}

}  // namespace

BodiesOfPairs::BodiesOfPairs(const minkray_bodies* given, std::size_t count, const char* argument)
    : given_((require(given, argument), *given)), argument_(argument) {
  if (given->size < sizeof(minkray_bodies))
    wrong_use(argument_ + ".size: must be sizeof(minkray_bodies)");
  check_count(given->shape_count, count, argument_ + ".shapes");
  if (given->shape_count > 0) require(given->shapes, (argument_ + ".shapes").c_str());
  const std::size_t dense = size_of_pose(given->pose_kind);
  if (dense == 0)
    wrong_use(argument_ + ".pose_kind: must be a minkray_pose_kind (got " +
              std::to_string(given->pose_kind) + ")");
  if (given->poses) {
    check_count(given->pose_count, count, argument_ + ".poses");
    if (given->pose_count > 1)
      pose_step_ =
          given->pose_stride != 0 ? given->pose_stride : static_cast<std::ptrdiff_t>(dense);
  }
  if (given->twists) check_count(given->twist_count, count, argument_ + ".twists");
  shapes_.reserve(given->shape_count);
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < given->shape_count; ++i) {
    const minkray_shape shape = given->shapes[i];
    if (i > 0 && shape.id == last) {
      shapes_.push_back(shapes_.back());
      continue;
    }
    last = shape.id;
    const HeldShape* const held = held_shapes().find(shape.id);
    if (!held) wrong_shape(shape, place(argument_, ".shapes", i).c_str());
    shapes_.push_back(held);
    for (const auto& custom : held->customs())
      if (std::ranges::find(customs_, custom) == customs_.end()) customs_.push_back(custom);
  }
  refuse_if_running(customs_, argument);
  // Prepares shapes before pairs wait for each other's support points, since a shape is locked
  // while it is prepared.
  for (const HeldShape* const held : shapes_)
    if (held->is_convex()) held->contact();
}

void PosedBody::take_map_in(const HeldShape& held) {
  const Affine<double> map{pose_.linear, Vec3<double>::Zero()};
  if (mesh_) {
    mesh_ = mapped(*mesh_, map);
  } else if (compound_) {
    compound_ = compound_->mapped(map);
  } else {
    own_ = std::make_unique<const ContactShape>(*held.shape(), map);
    shape_ = own_.get();
  }
  pose_.linear.setIdentity();
}

const ContactShape& PosedBody::shape_or_point() const {
  static const ContactShape point{Shape(Point())};
  return is_shape() ? *shape_ : point;
}

void BodiesOfPairs::read(std::size_t i, PosedBody& body) const {
  const HeldShape& held = *shapes_[shapes_.size() == 1 ? 0 : i];
  body.set(held);
  if (!given_.poses) {
    body.pose_ = Affine<double>();
    return;
  }
  const double* const numbers = reinterpret_cast<const double*>(
      reinterpret_cast<const char*>(given_.poses) + static_cast<std::ptrdiff_t>(i) * pose_step_);
  if (given_.pose_kind == MINKRAY_POSE_QUATERNION) {
    body.pose_ = pose_at(numbers, argument_, i);
    return;
  }
  if (given_.pose_kind == MINKRAY_POSE_MATRIX_4X4) check_last_row(numbers + 12, argument_, i);
  const auto& pose = *reinterpret_cast<const minkray_pose*>(numbers);
  const double x = pose.rows[0][3], y = pose.rows[1][3], z = pose.rows[2][3];
  // A finite number times zero is zero, any other is not.
  if (!are_orthonormal(pose.rows) || 0 * x + 0 * y + 0 * z != 0) [[unlikely]]
    return read_slowly(i, pose, body);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      body.pose_.linear(row, column) = pose.rows[row][column];
  body.pose_.translation = {x, y, z};
}

void BodiesOfPairs::read_slowly(std::size_t i, const minkray_pose& pose, PosedBody& body) const {
  const std::string argument = place(argument_, ".poses", i);
  read_pose(&pose, argument.c_str(), body.pose_);
  const Mat3<double>& linear = body.pose_.linear;
  const double off = (linear * linear.transpose() - Mat3<double>::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= most_off_rigid)) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", off);
    wrong_use(argument + ": must be rigid: rows of its linear part must have length 1 and be " +
              "square to each other (they are off by " + text + ")");
  }
  body.take_map_in(*shapes_[shapes_.size() == 1 ? 0 : i]);
}

RigidMotion BodiesOfPairs::motion(std::size_t i, const PosedBody& body) const {
  RigidMotion motion{body.pose()};
  if (!given_.twists) return motion;
  const minkray_twist& twist = given_.twists[given_.twist_count == 1 ? 0 : i];
  const double* const v = twist.velocity;
  const double* const w = twist.turn;
  if (0 * v[0] + 0 * v[1] + 0 * v[2] != 0 || 0 * w[0] + 0 * w[1] + 0 * w[2] != 0) [[unlikely]] {
    const std::string argument = place(argument_, ".twists", i);
    check_vector(v, argument.c_str(), ".velocity");
    check_vector(w, argument.c_str(), ".turn");
  }
  motion.velocity = {v[0], v[1], v[2]};
  motion.angular_velocity = {w[0], w[1], w[2]};
  return motion;
}

}  // namespace minkray
