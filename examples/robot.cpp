// SPDX-License-Identifier: MIT
// Rays at a robot whose joints move: robot ARM.URDF
#include <minkray/minkray.h>

#include <cstdio>

namespace mk = minkray;

int main(int argc, char** argv) {
  try {
    mk::Scene scene;
    auto arm = scene.add_file(argc > 1 ? argv[1] : "arm.urdf");
    for (const double elbow : {0.0, 0.5, 1.0}) {
      arm.set("elbow", elbow);
      scene.commit();
      const mk::Hit hit = scene.cast({{5, 0, 1.0}, {-1, 0, 0}});
      if (hit.found())
        std::printf("elbow %.1f: %s at t = %.6f\n", elbow, scene.name(hit.object), hit.t);
      else
        std::printf("elbow %.1f: nothing is met\n", elbow);
    }
  } catch (const mk::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
