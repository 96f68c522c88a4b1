// SPDX-License-Identifier: MIT
#include "core/world/parts_reach.h"

#include <algorithm>

#include "core/contact/core_support.h"

namespace minkray {

Vec3<double> middle_of(const PartsBody& body) {
  return body.mesh() ? body.mesh()->bounds().centre() : body.shape()->middle();
}

double reach_along(const PartsBody& body, const Mat3<double>& linear, const Vec3<double>& n) {
  if (!body.mesh()) {
    const Vec3<double> d = turn_in_world(*body.shape(), linear).transpose() * n;
    const ShapeCore& core = body.shape()->core();
    return d.dot(support_of_core<CoreKind::other>(core, d).point) + core.radius +
           core_rounding * (core.ball + core.radius) + core.rounding;
  }
  const TriangleMesh& mesh = *body.mesh();
  const Vec3<double> d = linear.transpose() * n, middle = middle_of(body);
  double furthest = -std::numeric_limits<double>::infinity();
  for (const Vec3<double>& vertex : mesh.vertices()) furthest = std::max(furthest, d.dot(vertex));
  // Vertices that no triangle has may be anywhere.
  const double of_box = d.cwiseAbs().dot(mesh.bounds().reach_of_centre());
  return std::min(furthest - d.dot(middle), of_box) + core_rounding * mesh.reach();
}

}  // namespace minkray
