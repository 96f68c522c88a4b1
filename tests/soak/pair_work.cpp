// SPDX-License-Identifier: MIT
// Pairs of shapes that are made and gone, and a robot on its way.
#include "tests/renderer/library/shapes.h"
#include "tests/soak/work.h"

namespace soak {
namespace {

/// Poses that put some pairs apart and some into each other.
mk::Pose beside(std::size_t i, std::size_t k) {
  const double by = 0.2 + 0.15 * static_cast<double>((3 * i + 5 * k) % 8);
  return mk::pose({by, 0.1 * static_cast<double>(k % 3), 0.3 * by},
                  {0.1 * static_cast<double>(i), 0.2, -0.3, 1});
}

}  // namespace

void distances(const Common&, Answers& answers) {
  const std::vector<mk::Shape> shapes = some_shapes();
  for (std::size_t i = 0; i < shapes.size(); ++i)
    for (std::size_t k = i; k < shapes.size(); k += 3) {
      const mk::Distance found =
          mk::signed_distance(shapes[i], mk::identity(), shapes[k], beside(i, k), 1e-6);
      expect(found.lower <= found.value && found.value <= found.upper, "bounds must be in order");
      answers.add(found);
    }
}

void first_contacts(const Common&, Answers& answers) {
  const std::vector<mk::Shape> shapes = some_shapes();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const std::size_t k = (7 * i + 3) % shapes.size();
    mk::Pose apart = beside(i, k);
    apart.rows[0][3] += 3;
    const mk::Twist turn = {{0, 0, 0}, {0.1, 0.4, 0}}, fly = {{-1, 0.02, 0}, {0, 0.3, 0.5}};
    const mk::Impact found =
        mk::time_of_impact(shapes[i], mk::identity(), turn, shapes[k], apart, fly, 5);
    answers.add(found);
  }
}

void clearances(const Common&, Answers& answers) {
  mk::Scene scene;
  const auto arm = scene.add_file(source_file("examples/arm.urdf"));
  scene.add(mk::sphere(0.1), mk::translation({1.6, 0, 0.9}), "ball");
  scene.commit();
  const double path[] = {0, 0, 0.7, 0.5, 1.4, 0.2};  // shoulder and elbow, in radians
  std::vector<mk::Clearance> steps(2);
  answers.add(scene.clearance(arm, path, 3, steps));
  answers.add_all(steps);
}

}  // namespace soak
