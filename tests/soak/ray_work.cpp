// SPDX-License-Identifier: MIT
// Rays at the scene that all threads query at once: one by one, in batches, by a lidar, proven,
// stopped half-way.
#include "tests/renderer/library/rays.h"
#include "tests/soak/work.h"

namespace soak {
namespace {

constexpr mk::Vec3 middle = {0, 0, 0.5};

}  // namespace

void single_casts(const Common& common, Answers& answers) {
  for (const mk::Ray& ray : rays_around(middle, 3, 1000, 1)) {
    answers.add(common.scene.cast(ray));
    answers.add(common.scene.occluded(ray));
  }
}

void batches(const Common& common, Answers& answers) {
  const std::vector<mk::Ray> rays = rays_around(middle, 3, 12000, 2);
  std::vector<mk::Hit> hits(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  common.scene.cast(rays, hits, {.threads = common.threads});
  common.scene.occluded(rays, blocked, {.threads = common.threads});
  answers.add_all(hits);
  answers.add_all(blocked);
  for (std::size_t i = 0; i < 200; ++i)
    if (hits[i].found() && hits[i].object != 19)  // the ground, which has no end
      answers.add(common.scene.exit(hits[i].object, rays[i]));
}

void proofs(const Common& common, Answers& answers) {
  const std::vector<mk::Ray> rays = rays_around(middle, 3, 400, 3);
  std::vector<mk::Hit> hits(rays.size());
  std::vector<mk::Proof> proofs(rays.size());
  common.scene.cast(rays, hits);
  common.scene.prove(rays, hits, proofs, {.threads = common.threads});
  for (const mk::Proof& proof : proofs) {
    expect(proof.holds == 1, "a proof must hold");
    answers.add(proof.t_lo);
    answers.add(proof.t_hi);
    answers.add(proof.plane);
    answers.add(proof.checked);
  }
}

void scans(const Common& common, Answers& answers) {
  for (int step = 0; step < 4; ++step) {
    const mk::Pose pose = mk::pose({-4 + 2.0 * step, 4, 1}, {0, 0, 0.2 * step, 1});
    std::vector<mk::Ray> rays(mk::lidar("spinning:16x360", pose));
    mk::lidar("spinning:16x360", pose, rays);
    std::vector<mk::Hit> hits(rays.size());
    common.scene.cast(rays, hits, {.threads = common.threads});
    answers.add_all(hits);
  }
}

void stopped_casts(const Common& common, Answers& answers) {
  const std::vector<mk::Ray> rays = rays_around(middle, 3, 12000, 4);
  std::vector<mk::Hit> hits(rays.size());
  const bool stopped = stopped_after(0.4, common.threads, [&](const mk::Options& options) {
    common.scene.cast(rays, hits, options);
  });
  common.stopped += stopped;
  common.scene.cast(rays, hits, {.threads = common.threads});
  answers.add_all(hits);
}

}  // namespace soak
