// SPDX-License-Identifier: MIT
// Memory and time of a million objects of one shape, turned at random. Memory is what is resident
// of this process, which makes one scene only.
#include <unistd.h>

#include <fstream>
#include <stdexcept>

#include "clock.h"
#include "rays.h"
#include "sections.h"

namespace bench {
namespace {

constexpr std::size_t object_count = 1'000'000;
constexpr double byte_goal = 180, add_goal = 1.5;

double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double all = 0, resident = 0;
  if (!(statm >> all >> resident)) throw std::runtime_error("cannot read /proc/self/statm");
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

std::string text_of(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void measure(Table& table, const Body& body) {
  Subject subject = make_subject("rounded boxes", object_count);
  std::vector<mk::Ray> rays = camera_rays(subject, 64);
  std::vector<mk::Hit> hits(rays.size());
  constexpr double each = object_count;

  const double before = resident_bytes();
  mk::Scene scene;
  const Clock adding;
  for (const Placed& object : subject.objects) scene.add(body.shape, object.pose);
  const double add_seconds = adding.processor();
  const Clock committing;
  scene.commit();
  const double commit_seconds = committing.processor();
  // Cast once, so that nothing is made at the first ray.
  scene.cast(rays, hits, {.threads = 1});
  scene.cast(rays[0]);
  const double bytes = (resident_bytes() - before) / each;

  std::size_t met = 0;
  Hash hash;
  for (const mk::Hit& hit : hits) {
    met += hit.found();
    hash.add(hit.t);
    hash.add(hit.object);
  }
  const Agreement agreement = {
      met > hits.size() / 20,
      text_of("%.0f %% hit", 100.0 * static_cast<double>(met) / static_cast<double>(hits.size()))};
  const std::string what = with_commas(object_count) + " objects: " + body.name;
  table.add(Figure{what, "bytes an object", text_of("%.0f bytes", bytes), "", bytes, byte_goal,
                   true, agreement, hash.value()});
  table.add(Figure{what, "Scene::add", text_of("%.2f s", add_seconds), "", add_seconds, add_goal,
                   true, agreement, hash.value()});
  table.add(Figure{what, "Scene::commit", text_of("%.2f s", commit_seconds), "", commit_seconds, 0,
                   true, agreement, hash.value()});
}

}  // namespace

std::vector<Section> memory_sections() {
  return {{"memory: box",
           [](Table& table, const Options&) {
             measure(table, box({0.5, 0.35, 0.2}));
           }},
          {"memory: hull 16", [](Table& table, const Options&) {
             measure(table, hull(random_points(16, {0.75, 0.5, 0.35}, 7)));
           }}};
}

}  // namespace bench
