// SPDX-License-Identifier: MIT
// A custom shape: a cylinder cut by two oblique planes (as FCL's issue 642 requests), given
// by its support function. 1000 rays at it are proven.
#include <minkray/minkray.h>

#include <cmath>
#include <cstdio>
#include <vector>

namespace mk = minkray;

// The point of the ellipse z = height + a x + b y, x^2 + y^2 = 1 that lies furthest along n.
mk::Vec3 rim(const mk::Vec3& n, double height, double a, double b) {
  const double x = n.x + n.z * a, y = n.y + n.z * b, length = std::hypot(x, y);
  const mk::Vec3 p = length > 0 ? mk::Vec3{x / length, y / length, 0} : mk::Vec3{1, 0, 0};
  return {p.x, p.y, height + a * p.x + b * p.y};
}

int main() {
  const mk::Shape cut = mk::custom([](const mk::Vec3& n) {
    const mk::Vec3 low = rim(n, -1, 0.2, 0.3), high = rim(n, 1, -0.4, 0.1);
    const auto along = [&](const mk::Vec3& p) { return n.x * p.x + n.y * p.y + n.z * p.z; };
    return along(high) > along(low) ? high : low;
  });
  mk::Scene scene;
  scene.add(cut);
  scene.commit();
  std::vector<mk::Ray> rays;
  for (int i = 0; i < 1000; ++i)
    rays.push_back({{-5, 0.003 * i - 1.5, 0.002 * i - 1}, {1, 0.0001 * i, 0.05}});
  std::vector<mk::Hit> hits(rays.size());
  std::vector<mk::Proof> proofs(rays.size());
  scene.cast(rays, hits);
  scene.prove(rays, hits, proofs);
  int met = 0, proven = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    met += hits[i].found();
    proven += proofs[i].holds;
  }
  std::printf("%d of 1000 rays hit, %d answers are proven\n", met, proven);
  return proven == 1000 ? 0 : 1;
}
