// SPDX-License-Identifier: MIT
#include "core/derived/sum_of_cores.h"

#include <array>
#include <utility>

namespace minkray {
namespace {

class Gatherer {
 public:
  /// Adds the image of a shape, or the images of its operands. Returns false if a sum of two cores
  /// cannot represent them.
  bool add(const Shape& shape, const ComposedMap& map) {
    if (const auto* transform = std::get_if<Transform>(&shape.kind))
      return add(*transform->shape, map * ComposedMap(transform->map.affine()));
    if (const auto* sum = std::get_if<MinkowskiSum>(&shape.kind)) {
      middle_ = middle_ + map.translation;
      loss_ += map.loss;
      for (const Nested& operand : sum->shapes)
        if (!add(*operand, map.about_origin())) return false;
      return true;
    }
    if (const auto* difference = std::get_if<MinkowskiDifference>(&shape.kind)) {
      middle_ = middle_ + map.translation;
      loss_ += map.loss;
      return add(*difference->a, map.about_origin()) &&
             add(*difference->b, map.about_origin().mirrored());
    }
    if (const auto* rounded = std::get_if<Rounded>(&shape.kind))
      return add(*rounded->shape, map) && add(Shape(Sphere{rounded->radius}), map.about_origin());
    CoreAndRadius core = core_and_radius(shape, map);
    if (core.core.kind == CoreKind::other) return false;
    middle_ = middle_ + TwoFoldVec3<double>(core.middle, core.middle_low);
    loss_ += core.core.rounding;
    if (core.core.kind == CoreKind::point) {
      radius_ += core.core.radius;
      return true;
    }
    if (count_ == 2) return false;
    cores_[count_++] = std::move(core);
    return true;
  }

  std::optional<SumOfCores> found() {
    if (count_ == 0 || (count_ == 1 && !(radius_ > 0))) return {};
    (count_ == 1 ? cores_[1] : cores_[0]).core.radius += radius_;
    // Solvers are compiled for pairs whose kinds are in ascending order.
    if (cores_[1].core.kind < cores_[0].core.kind) std::swap(cores_[0], cores_[1]);
    return SumOfCores{std::move(cores_[0]), std::move(cores_[1]), middle_.rounded(), loss_};
  }

 private:
  std::array<CoreAndRadius, 2> cores_;  ///< a CoreAndRadius is a point unless it is set
  std::size_t count_ = 0;
  TwoFoldVec3<double> middle_;
  double radius_ = 0, loss_ = 0;
};

/// True if the shape is a sum, difference or rounded shape, possibly mapped.
bool is_sum(const Shape& shape) {
  if (const auto* transform = std::get_if<Transform>(&shape.kind)) return is_sum(*transform->shape);
  return std::holds_alternative<Rounded>(shape.kind) ||
         std::holds_alternative<MinkowskiSum>(shape.kind) ||
         std::holds_alternative<MinkowskiDifference>(shape.kind);
}

}  // namespace

std::optional<SumOfCores> sum_of_cores(const Shape& shape) {
  if (!is_sum(shape)) return {};
  Gatherer gatherer;
  if (!gatherer.add(shape, {})) return {};
  return gatherer.found();
}

}  // namespace minkray
