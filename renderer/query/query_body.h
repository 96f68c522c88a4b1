// SPDX-License-Identifier: MIT
// A body in a query: a convex shape, or a mesh with its pose.
#pragma once

#include <memory>

#include "core/math/affine.h"
#include "core/mesh/triangle_mesh.h"
#include "core/shape/shape.h"

namespace minkray {

struct QueryBody {
  Shape shape = Point();  ///< unless there is a mesh
  std::shared_ptr<const TriangleMesh> mesh = nullptr;
  Affine<double> pose = {};  ///< maps the mesh's frame to the query's; invertible

  QueryBody() = default;
  QueryBody(Shape of) : shape(std::move(of)) {}
  QueryBody(std::shared_ptr<const TriangleMesh> of, const Affine<double>& at)
      : mesh(std::move(of)), pose(at) {}
};

}  // namespace minkray
