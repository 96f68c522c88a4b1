// SPDX-License-Identifier: MIT
// A scene as plain data: what a scene file says, with defaults filled in and names resolved.
// Lengths are in the scene's unit, directions need not be of unit length, colours are linear RGB.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/math/affine.h"
#include "core/math/vec.h"
#include "core/shape/shape.h"

namespace minkray {

using Colour = Vec3<double>;

struct Resolution {
  int width = 960;
  int height = 540;
};

struct CameraDescription {
  Vec3<double> position = {0, -5, 0};
  Vec3<double> look_at = {0, 0, 0};
  Vec3<double> up = {0, 0, 1};
  double fov_y_degrees = 40;
  Resolution resolution;
};

/// Light that travels along `direction`, as from the sun; `colour` is the irradiance on a surface
/// that faces it.
struct DirectionalLight {
  Vec3<double> direction = {0, 0, -1};
  Colour colour = Colour::Ones();
};

/// Light from a point; `colour` is its radiant intensity, so that the irradiance falls off as
/// colour / distance^2.
struct PointLight {
  Vec3<double> position = Vec3<double>::Zero();
  Colour colour = Colour::Ones();
};

/// Light from all around: the radiance from straight up and from straight down, blended by height.
struct EnvironmentLight {
  Colour zenith = Colour::Ones();
  Colour nadir = Colour::Ones();
};

using Light = std::variant<DirectionalLight, PointLight, EnvironmentLight>;

/// Diffuse reflection.
struct LambertMaterial {
  Colour colour = Colour::Constant(0.7);
};

/// A diffuse base under a dielectric coat that mirrors by Fresnel's law; `roughness` 0 is a mirror.
struct GlossyMaterial {
  Colour colour = Colour::Constant(0.7);
  double roughness = 0.1;
  double index_of_refraction = 1.5;
};

struct Material {
  std::string name;
  std::variant<LambertMaterial, GlossyMaterial> kind;
};

struct Object {
  std::string name;
  Shape<double> shape;
  Affine<double> pose;           ///< from the shape's frame to the world
  std::uint32_t material = 0;    ///< index into Scene::materials
};

/// What a ray sees that meets nothing: a vertical gradient.
struct Background {
  Colour zenith = Colour::Constant(1);
  Colour nadir = Colour::Constant(1);
};

struct Scene {
  std::string description;
  CameraDescription camera;
  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Object> objects;
  Background background;
};

}  // namespace minkray
