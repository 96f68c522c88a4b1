// SPDX-License-Identifier: MIT
// One side of many pairs of shapes, from Python.
#pragma once

#include <vector>

#include "renderer/library/python/arrays.h"

namespace minkray_python {

/// Shapes, one or as many as pairs, and their poses and twists; see minkray_bodies.
class Side {
 public:
  Side(const py::list& shapes, const py::object& poses, int pose_kind, const py::object& twists)
      : poses_(poses), twists_(twists) {
    shapes_.reserve(shapes.size());
    for (const py::handle shape : shapes)
      shapes_.push_back(shape.cast<const minkray::Shape&>().handle());
    plain_.size = sizeof plain_;
    plain_.shapes = shapes_.data();
    plain_.shape_count = shapes_.size();
    plain_.pose_kind = pose_kind;
    if (!poses.is_none()) {
      const auto array = poses.cast<AnyDoubles>();
      plain_.poses = array.data();
      plain_.pose_count = static_cast<std::size_t>(array.shape(0));
      plain_.pose_stride = array.strides(0);
    }
    if (!twists.is_none()) {
      const auto array = twists.cast<Doubles>();
      plain_.twists = reinterpret_cast<const minkray_twist*>(array.data());
      plain_.twist_count = static_cast<std::size_t>(array.shape(0));
    }
  }
  const minkray_bodies* plain() const { return &plain_; }

 private:
  std::vector<minkray_shape> shapes_;
  py::object poses_, twists_;  ///< for as long as they are read
  minkray_bodies plain_ = {};
};

}  // namespace minkray_python
