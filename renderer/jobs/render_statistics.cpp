// SPDX-License-Identifier: MIT
#include "renderer/jobs/render_statistics.h"

#include <iomanip>
#include <iostream>
#include <sstream>

#include "core/parallel/parallel.h"
#include "renderer/arguments/image_arguments.h"
#include "renderer/json/json.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

Json as_json(const RenderStatistics& s) {
  const RayCounts& c = s.counts;
  return {{"objects", s.objects},
          {"threads", s.threads},
          {"seconds",
           {{"load", s.load_seconds},
            {"build", s.build_seconds},
            {"trace", s.trace_seconds},
            {"write", s.write_seconds}}},
          {"rays",
           {{"camera", c.camera},
            {"shadow", c.shadow},
            {"ambient", c.ambient},
            {"scattered", c.scattered},
            {"mirrored", c.mirrored},
            {"total", c.total()}}},
          {"rays_per_second", static_cast<double>(c.total()) / s.trace_seconds},
          {"per_ray",
           {{"nodes", s.per_ray(c.work.nodes)},
            {"casts", s.per_ray(c.work.casts)},
            {"iterations", s.per_ray(c.work.iterations)},
            {"supports", s.per_ray(c.work.supports)}}},
          {"answered_by",
           {{"filter", c.work.answered_by(Path::filter)},
            {"model", c.work.answered_by(Path::model)},
            {"gjk", c.work.answered_by(Path::gjk)},
            {"finer", c.work.answered_by(Path::finer)}}},
          {"noise", s.noise < 0 ? Json() : Json(s.noise)},
          {"exhausted", c.work.exhausted},
          {"camera_rays_from_inside", c.from_inside},
          {"bytes",
           {{"world", s.world_bytes},
            {"hierarchy", s.bvh_bytes},
            {"per_object", s.per_object(s.world_bytes)}}}};
}

void print(const RenderStatistics& s) {
  const RayCounts& c = s.counts;
  const auto seconds = [](double value) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(3) << value << " s";
    return text.str();
  };
  std::ostringstream noise;
  noise << std::setprecision(3);
  if (s.noise < 0)
    noise << "not known by single samples";
  else
    noise << 100 * s.noise << " % of a pixel's brightness, in the mean";
  std::cout << "objects     " << s.objects << "\n"
            << "threads     " << s.threads << "\n"
            << "time        load " << seconds(s.load_seconds) << ", build "
            << seconds(s.build_seconds) << ", trace " << seconds(s.trace_seconds) << ", write "
            << seconds(s.write_seconds) << "\n"
            << "rays        " << c.total() << ": camera " << c.camera << ", shadow " << c.shadow
            << ", ambient " << c.ambient << ", scattered " << c.scattered << ", mirrored "
            << c.mirrored << "\n"
            << "speed       " << std::setprecision(4)
            << static_cast<double>(c.total()) / s.trace_seconds / 1e6 << " Mray/s\n"
            << "per ray     " << s.per_ray(c.work.nodes) << " nodes, " << s.per_ray(c.work.casts)
            << " casts, " << s.per_ray(c.work.iterations) << " iterations, "
            << s.per_ray(c.work.supports) << " support points\n"
            << "answered by filter " << c.work.answered_by(Path::filter) << ", model "
            << c.work.answered_by(Path::model) << ", gjk " << c.work.answered_by(Path::gjk)
            << ", finer " << c.work.answered_by(Path::finer) << "\n"
            << "noise       " << noise.str() << "\n"
            << "exhausted   " << c.work.exhausted << " casts\n"
            << "memory      " << s.world_bytes << " bytes, of which the hierarchy " << s.bvh_bytes
            << "; " << s.per_object(s.world_bytes) << " an object, of which the hierarchy "
            << s.per_object(s.bvh_bytes) << "\n";
}

}  // namespace

void RenderStatistics::describe(const Scene& scene, const World& world) {
  objects = instance_count(scene);
  threads = thread_count();
  world_bytes = world.bytes();
  bvh_bytes = world.bvh().bytes();
}

void report(const RenderStatistics& statistics, const std::string& stats) {
  warn_of_counts(statistics.counts);
  if (stats == "json") std::cout << as_json(statistics).dump(2) << "\n";
  if (stats == "true") print(statistics);
}

}  // namespace minkray
