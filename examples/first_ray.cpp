// SPDX-License-Identifier: MIT
// A ray at a rounded box: where it enters, between which bounds, and the proof of it.
#include <minkray/minkray.h>

#include <cstdio>

namespace mk = minkray;

int main() {
  mk::Scene scene;
  scene.add(mk::rounded(mk::box({.5, .2, .1}), .05), mk::translation({1, 0, 0}), "bumper");
  scene.add_half_space({0, 0, 1}, -1, "ground");
  scene.commit();
  const mk::Ray ray = {{-9, 0.1, 0}, {1, 0, 0}};
  const mk::Hit hit = scene.cast(ray);
  if (hit.status != mk::hit) return 1;
  std::printf("%s at t = %.17g, between %.17g and %.17g; proven: %s\n", scene.name(hit.object),
              hit.t, hit.t_lo, hit.t_hi, scene.prove(ray, hit).holds ? "yes" : "no");
}
