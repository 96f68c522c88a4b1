// SPDX-License-Identifier: MIT
// The Open Dynamics Engine's rays at its primitive shapes, in its precision (Debian's is double).
#pragma once

#include <memory>

#include "core/math/ray.h"
#include "core/shape/shape.h"

namespace minkray::testing {

class OdeRay {
 public:
  /// Nothing for shapes that ODE does not have (it has sphere, capsule, cylinder, box).
  static std::unique_ptr<OdeRay> make(const Shape& shape);
  ~OdeRay();

  /// The ray's parameter where it enters, for rays from outside; infinite for no hit before t_max,
  /// which must be finite.
  double entry(const Ray<double>& ray) const;

 private:
  struct State;
  explicit OdeRay(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace minkray::testing
