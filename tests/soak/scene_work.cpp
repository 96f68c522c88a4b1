// SPDX-License-Identifier: MIT
// Scenes of a thread's own that are changed between queries, and shapes of the user's own. The
// library removes nothing from a scene: to lose an object it is rebuilt; a hidden object is far
// away.
#include <cmath>

#include "tests/renderer/library/ellipsoid_jet.h"
#include "tests/renderer/library/rays.h"
#include "tests/renderer/library/shapes.h"
#include "tests/soak/work.h"

namespace soak {
namespace {

void ask(const mk::Scene& scene, Answers& answers, int threads, std::size_t count = 2000) {
  const std::vector<mk::Ray> rays = rays_around({0, 0, 0.5}, 3, count, 5);
  std::vector<mk::Hit> hits(rays.size());
  scene.cast(rays, hits, {.threads = threads});
  answers.add_all(hits);
}

}  // namespace

void edits(const Common& common, Answers& answers) {
  constexpr std::uint32_t bodies = 19;
  mk::Scene scene = scene_of_shapes();
  ask(scene, answers, common.threads);

  // Things move: the hierarchy is refitted.
  const mk::Pose shift = mk::pose({0.3, -0.2, 0.5}, {0, 0.1, 0, 1});
  for (std::uint32_t i = 0; i < bodies; i += 2) scene.set_pose(i, shift * scene.pose(i));
  scene.commit();
  ask(scene, answers, common.threads);

  // One is hidden far away, and shown again.
  Answers before, hidden, after;
  const mk::Pose place = scene.pose(2);
  ask(scene, before, common.threads);
  scene.set_pose(2, mk::translation({0, 0, 1e4}));
  scene.commit();
  ask(scene, hidden, common.threads);
  scene.set_pose(2, place);
  scene.commit();
  ask(scene, after, common.threads);
  expect(before.hash() == after.hash(), "what is shown again must be met as before");
  expect(before.hash() != hidden.hash(), "what is hidden must not be met");
  answers.add(hidden.hash());

  // Adds more, so that it is rebuilt; among them a robot, whose joints move.
  for (std::uint32_t i = 0; i < 40; ++i)
    scene.add(mk::sphere(0.1 + 0.005 * i), mk::translation({-2 + 0.1 * i, 2, 0.5}), "pearl");
  auto arm = scene.add_file(source_file("examples/arm.urdf"));
  scene.commit();
  ask(scene, answers, common.threads);
  for (const double angle : {0.4, -0.9}) {
    arm.set("shoulder", angle);
    scene.commit();
    ask(scene, answers, common.threads);
  }

  // Without every third body.
  mk::Scene fewer;
  const std::vector<mk::Shape> shapes = some_shapes();
  for (std::uint32_t i = 0; i < bodies; ++i)
    if (i % 3 != 0) fewer.add(shapes[i], scene.pose(i), scene.name(i));
  scene = std::move(fewer);
  scene.commit();
  ask(scene, answers, common.threads);
}

void files(const Common& common, Answers& answers) {
  for (const char* name : {"scenes/shape-zoo.json", "scenes/bent-pipe.json"}) {
    mk::Scene scene;
    const auto group = scene.add_file(source_file(name));
    scene.commit();
    answers.add(group.size());
    ask(scene, answers, common.threads);
    group.size() > 0 ? answers.add_text(scene.name(group.first())) : answers.add_text("");
  }
  for (const mk::Shape& shape : some_shapes()) {
    const std::string text = shape.json<std::string>();
    expect(mk::read_shape(text).json<std::string>() == text,
           "what is written must be read as the same");
    answers.add_text(text);
  }
}

void custom_shapes(const Common& common, Answers& answers) {
  const auto box = [](const mk::Vec3& n) {
    return mk::Vec3{std::copysign(0.5, n.x), std::copysign(0.3, n.y), std::copysign(0.4, n.z)};
  };
  const auto boxes = [box](mk::View<const mk::Vec3> directions, mk::View<mk::Vec3> points) {
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = box(directions[i]);
  };
  mk::Scene scene;
  scene.add(mk::custom(box));
  scene.add(mk::rounded(mk::custom_batched(boxes, 64), 0.1), mk::translation({2, 0, 0}));
  scene.add(mk::custom_with_jets(ellipsoid_jet), mk::translation({-2, 0.2, 0.4}));
  scene.commit();
  ask(scene, answers, common.threads, 1000);
}

}  // namespace soak
