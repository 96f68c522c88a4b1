// SPDX-License-Identifier: MIT
#include "renderer/paths/integrator.h"

#include <algorithm>

#include "renderer/paths/ambient_transport.h"
#include "renderer/paths/normals_transport.h"
#include "renderer/paths/path_transport.h"

namespace minkray {
namespace {

std::unique_ptr<const LightTransport> transport(const Scene& scene, const World& world,
                                                IntegratorOptions options) {
  switch (settled(options.kind, scene)) {
    case IntegratorKind::direct:
      options.max_depth = 1;
      [[fallthrough]];
    case IntegratorKind::path:
      return std::make_unique<PathTransport>(scene, world, options);
    case IntegratorKind::normals:
      return std::make_unique<NormalsTransport>(world, options);
    case IntegratorKind::automatic:
    case IntegratorKind::ambient:
      break;
  }
  return std::make_unique<AmbientTransport>(scene, world, options);
}

}  // namespace

IntegratorKind settled(IntegratorKind kind, const Scene& scene) {
  if (kind != IntegratorKind::automatic) return kind;
  const bool wants_paths =
      std::any_of(scene.materials.begin(), scene.materials.end(),
                  [](const Material& material) {
                    return is_painted(material) ||
                           (!std::holds_alternative<LambertMaterial>(material.kind) &&
                            !std::holds_alternative<GlossyMaterial>(material.kind));
                  }) ||
      std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
        return std::holds_alternative<ImageSkyLight>(light) ||
               std::holds_alternative<SunSkyLight>(light);
      });
  return wants_paths ? IntegratorKind::path : IntegratorKind::ambient;
}

Integrator::Integrator(const Scene& scene, const World& world, const IntegratorOptions& options)
    : transport_(transport(scene, world, options)) {}

}  // namespace minkray
