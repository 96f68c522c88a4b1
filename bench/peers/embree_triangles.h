// SPDX-License-Identifier: MIT
// Embree on the convex hull of many support points of a shape: what a triangle ray tracer would
// draw in its place. One ray at a time.
#pragma once

#include <memory>

#include "core/math/ray.h"
#include "core/shape/shape.h"

namespace minkray::bench {

class EmbreeTriangles {
 public:
  /// The hull of the shape's support points in `longitudes` times half as many directions.
  EmbreeTriangles(const Shape<double>& shape, int longitudes);
  ~EmbreeTriangles();
  EmbreeTriangles(const EmbreeTriangles&) = delete;
  EmbreeTriangles& operator=(const EmbreeTriangles&) = delete;

  /// The parameter of the nearest triangle met; infinite for none.
  float entry(const Ray<float>& ray) const;
  std::size_t triangles() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace minkray::bench
