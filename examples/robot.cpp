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
      std::printf("elbow %.1f: %s\n", elbow,
                  hit.found() ? scene.name(hit.object) : "nothing is met");
    }
  } catch (const mk::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
