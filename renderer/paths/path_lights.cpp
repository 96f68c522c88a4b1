// SPDX-License-Identifier: MIT
// Direct light from lights and emissive bodies at the vertices of paths.
#include "renderer/paths/path_wave.h"

namespace minkray {

template <class Draw, class Part>
void PathTransport::Wave::ask_for(const Draw& draw, const Part& part) {
  shadows_.clear();
  for (const std::size_t i : scattering_) {
    if (points_[i]->bsdf->is_sharp()) continue;
    const Point& point = *points_[i];
    const std::optional<LightSample> sample = draw(point, paths_[i].sampler);
    if (!sample) continue;
    const Vec3<double> w = point.frame.to_local(sample->direction);
    if (!point.is_on_side(w, sample->direction) || !point.inside(w).none()) continue;
    const Colour reflected = point.bsdf->eval(point.shading, w);
    if (!(reflected.maxCoeff() > 0)) continue;
    const double counts = part(point, w, *sample);
    if (!(counts > 0)) continue;
    Ray<double> ray = point.ray(w, sample->direction);
    ray.t_max = sample->distance;
    shadows_.add({ray, point.instance, paths_[i].time, shadow_rays},
                 {i, counts * sample->weight.cwiseProduct(reflected), no_instance});
  }
  ask_shadows();
}

void PathTransport::Wave::ask_light(std::size_t light) {
  ask_for([&](const Point& point,
              Sampler& sampler) { return of_.lights_.sample(light, point.lit_at(), sampler); },
          [](const Point&, const Vec3<double>&, const LightSample&) { return 1.0; });
}

void PathTransport::Wave::ask_sky(const SkySource& sky) {
  if (!sky.is_asked()) return;
  ask_for([&](const Point& point, Sampler& sampler) { return sky.sample(point.lit_at(), sampler); },
          [&](const Point& point, const Vec3<double>& w, const LightSample& sample) {
            const double density = sky.pdf(point.lit_at(), sample.direction);
            return density > 0 ? share(density, point.bsdf->pdf(point.shading, w)) : 0.0;
          });
}

void PathTransport::Wave::ask_shadows() {
  counts_.shadow += shadows_.rays.size();
  of_.casts_.find_blocked(RayKind::shadow, shadows_.rays, blocked_, counts_.work);
  for (std::size_t k = 0; k < blocked_.size(); ++k)
    if (!blocked_[k]) add(shadows_.arriving[k]);
}

void PathTransport::Wave::ask_emitters() {
  shadows_.clear();
  for (const std::size_t i : scattering_) {
    if (points_[i]->bsdf->is_sharp()) continue;
    const Point& point = *points_[i];
    Path& path = paths_[i];
    const auto sample = of_.emitters_.sample(point.lit_at(), path.time, path.sampler);
    if (!sample) continue;
    const Vec3<double> w = point.frame.to_local(sample->direction);
    if (!point.is_on_side(w, sample->direction)) continue;
    const Colour reflected = point.bsdf->eval(point.shading, w);
    if (!(reflected.maxCoeff() > 0)) continue;
    const double part = share(sample->pdf, point.bsdf->pdf(point.shading, w)) / sample->pdf;
    const std::uint32_t lamp = of_.emitters_.instance(sample->emitter);
    const Colour& radiance = sample->part == no_part
                                 ? of_.emitters_.radiance(sample->emitter)
                                 : of_.surfaces_.of(lamp, sample->part).radiance;
    const Arriving light{i, part * radiance.cwiseProduct(reflected), lamp, sample->part};
    const WorldRay ray{point.ray(w, sample->direction), point.instance, path.time, shadow_rays};
    if (point.inside(w).none())
      shadows_.add(ray, light);
    else
      ask_within(ray, point.inside(w), light);
  }
  counts_.shadow += shadows_.rays.size();
  of_.casts_.find_hits([](std::size_t) { return RayKind::shadow; }, shadows_.rays, hits_,
                       counts_.work);
  for (std::size_t k = 0; k < hits_.size(); ++k)
    if (shadows_.arriving[k].is_from(hits_[k].instance, hits_[k].part) &&
        hits_[k].cast.status == Status::hit)
      add(shadows_.arriving[k]);
}

void PathTransport::Wave::ask_within(const WorldRay& ray, const Inside& inside, Arriving light) {
  ++counts_.shadow;
  const Boundary met = next_boundary(of_.world_, ray, inside, counts_.work);
  if (!light.is_from(met.instance, met.part) || met.leaves || met.is_within || met.is_lost) return;
  light.light.array() *= left_after(medium(inside), met.t).array();
  add(light);
}

void PathTransport::Wave::add(const Arriving& arriving) {
  Path& path = paths_[arriving.path];
  gather(path, path.throughput.cwiseProduct(arriving.light), path.depth + 1);
}

}  // namespace minkray
