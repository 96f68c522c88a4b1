// SPDX-License-Identifier: MIT
// Minkray in one program with vectorised Eigen (and FCL): each keeps its own. Prints what
// `minkray cast` prints of the same rays: beside_eigen SCENE.JSON
#include <minkray/minkray.h>

#include <Eigen/Dense>
#include <cstdio>
#ifdef HAS_FCL
#include <fcl/fcl.h>
#endif

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  Eigen::Matrix4d a = Eigen::Matrix4d::Random();
  const double residual = (a * a.inverse() - Eigen::Matrix4d::Identity()).norm();
#ifdef HAS_FCL
  fcl::Boxd box(1, 1, 1);
  const Eigen::Vector3d side = box.side;
  if (side.sum() != 3) return 1;
#endif
  minkray::Scene scene;
  scene.add_file(argv[1]);
  scene.commit();
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d from(8 - 0.08 * i, -9, 3), to(0.02 * i - 2, 0.5, 0.004 * i);
    const Eigen::Vector3d d = to - from;
    const minkray::Ray ray = {{from.x(), from.y(), from.z()}, {d.x(), d.y(), d.z()}};
    const minkray::Hit hit = scene.cast(ray);
    std::printf("%.17g %.17g %.17g %.17g %.17g %.17g %d %.17g\n", from.x(), from.y(), from.z(),
                d.x(), d.y(), d.z(), int(hit.status), hit.found() ? hit.t : 0.0);
  }
  return residual < 1e-10 ? 0 : 1;
}
