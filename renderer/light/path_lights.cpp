// SPDX-License-Identifier: MIT
// What lights and shining bodies send to the ends of paths.
#include "renderer/light/path_packet.h"

namespace minkray {

template <class Draw, class Part>
void PathTransport::Packet::ask_for(const Draw& draw, const Part& part) {
  ShadowRays shadows;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    if (!points_[i] || points_[i]->bsdf->is_sharp()) continue;
    const Point& point = *points_[i];
    const std::optional<LightSample> sample = draw(point, paths_[i].sampler);
    if (!sample) continue;
    const Vec3<double> w = point.frame.to_local(sample->direction);
    if (!point.is_on_side(w, sample->direction) || !point.inside(w).none()) continue;
    const Colour reflected = point.bsdf->eval(point.shading, w);
    if (!(reflected.maxCoeff() > 0)) continue;
    const double counts = part(point, w, *sample);
    if (!(counts > 0)) continue;
    Ray<Real> ray = point.ray(w, sample->direction);
    ray.t_max = sample->distance;
    shadows.add({ray, point.instance, paths_[i].time},
                {i, counts * sample->weight.cwiseProduct(reflected), no_instance});
  }
  ask(shadows);
}

void PathTransport::Packet::ask_light(std::size_t light) {
  ask_for([&](const Point& point,
              Sampler& sampler) { return of_.lights_.sample(light, point.position, sampler); },
          [](const Point&, const Vec3<double>&, const LightSample&) { return 1.0; });
}

void PathTransport::Packet::ask_sky(const SkySource& sky) {
  if (!sky.is_asked()) return;
  ask_for([&](const Point& point, Sampler& sampler) { return sky.sample(point.position, sampler); },
          [&](const Point& point, const Vec3<double>& w, const LightSample& sample) {
            const double density = sky.pdf(point.position, sample.direction);
            return density > 0 ? share(density, point.bsdf->pdf(point.shading, w)) : 0.0;
          });
}

void PathTransport::Packet::ask(const ShadowRays& shadows) {
  counts_.shadow += shadows.count;
  const RayGroupMask blocked = of_.world_.occluded(shadows.asked(), counts_.work);
  for (std::size_t k = 0; k < shadows.count; ++k) {
    const bool answer = blocked >> k & 1;
    if (of_.options_.observer)
      of_.options_.observer->occluded(RayKind::shadow, shadows.rays[k].ray, shadows.rays[k].skip,
                                      answer);
    if (!answer) add(shadows.arriving[k]);
  }
}

void PathTransport::Packet::ask_emitters() {
  ShadowRays shadows;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    if (!points_[i] || points_[i]->bsdf->is_sharp()) continue;
    const Point& point = *points_[i];
    Path& path = paths_[i];
    const auto sample = of_.emitters_.sample(point.position, path.time, path.sampler);
    if (!sample) continue;
    const Vec3<double> w = point.frame.to_local(sample->direction);
    if (!point.is_on_side(w, sample->direction)) continue;
    const Colour reflected = point.bsdf->eval(point.shading, w);
    if (!(reflected.maxCoeff() > 0)) continue;
    const double part = share(sample->pdf, point.bsdf->pdf(point.shading, w)) / sample->pdf;
    const Arriving light{i, part * of_.emitters_.radiance(sample->emitter).cwiseProduct(reflected),
                         of_.emitters_.instance(sample->emitter)};
    const WorldRay<Real> ray{point.ray(w, sample->direction), point.instance, path.time};
    if (point.inside(w).none())
      shadows.add(ray, light);
    else
      ask_within(ray, point.inside(w), light);
  }
  counts_.shadow += shadows.count;
  std::array<WorldHit<Real>, most_in_ray_group> hits;
  if (shadows.count > 0) of_.world_.closest_hits(shadows.asked(), hits, counts_.work);
  for (std::size_t k = 0; k < shadows.count; ++k) {
    if (of_.options_.observer)
      of_.options_.observer->closest(RayKind::shadow, shadows.rays[k].ray, shadows.rays[k].skip,
                                     hits[k]);
    if (hits[k].instance == shadows.arriving[k].emitter && hits[k].cast.status == Status::hit)
      add(shadows.arriving[k]);
  }
}

void PathTransport::Packet::ask_within(const WorldRay<Real>& ray, const Inside& inside,
                                       Arriving light) {
  ++counts_.shadow;
  const Boundary met = next_boundary(of_.world_, ray, inside, counts_.work);
  if (met.instance != light.emitter || met.leaves || met.is_within || met.is_lost) return;
  light.light.array() *= left_after(medium(inside), met.t).array();
  add(light);
}

void PathTransport::Packet::add(const Arriving& arriving) {
  Path& path = paths_[arriving.path];
  gather(path, path.throughput.cwiseProduct(arriving.light), path.depth + 1);
}

}  // namespace minkray
