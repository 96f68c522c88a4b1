// SPDX-License-Identifier: MIT
// A robot's way, proven to be clear at all times and not at samples: path ARM.URDF
#include <minkray/minkray.h>

#include <cstdio>
#include <vector>

namespace mk = minkray;

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  mk::Scene scene;
  const auto arm = scene.add_file(argv[1]);
  scene.add(mk::sphere(0.1), mk::translation({1.6, 0, 0.9}), "ball");
  scene.commit();
  const double path[] = {0, 0, 0.7, 0.5, 1.4, 0.2};  // shoulder and elbow, in radians
  std::vector<mk::Clearance> steps(2);
  const mk::Clearance least = scene.clearance(arm, path, 3, steps);
  for (const mk::Clearance& step : steps)
    std::printf("between %.4f and %.4f, nearest at row %.3f: %s and %s\n", step.lower, step.upper,
                step.row, scene.name(step.object_a), scene.name(step.object_b));
  return least.lower > 0 ? 0 : 1;
}
