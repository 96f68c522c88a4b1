// SPDX-License-Identifier: MIT
// Materials of scene files: one struct per material; the list of all is at the end.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/math/vec.h"
#include "core/support/field.h"
#include "renderer/scene/relief.h"
#include "renderer/scene/textures.h"
#include "renderer/scene/visible_to.h"

namespace minkray {

/// Diffuse reflection.
struct LambertMaterial {
  Paint colour = Colour::Constant(0.7);

  static constexpr std::string_view name = "lambert";
  static constexpr std::string_view doc = "Matt: diffuse reflection.";
  static constexpr auto fields() {
    return std::tuple{Field{"color", &LambertMaterial::colour, Unit::none, Range::zero_to_one,
                            "the fraction of light that is reflected (linear RGB)"}};
  }
};

/// A diffuse base under a dielectric coat that mirrors by Fresnel's law; `roughness` 0 is a mirror.
struct GlossyMaterial {
  Paint colour = Colour::Constant(0.7);
  double roughness = 0.1;
  double index_of_refraction = 1.5;

  static constexpr std::string_view name = "glossy";
  static constexpr std::string_view doc = "A diffuse base under a reflecting coat.";
  static constexpr auto fields() {
    using M = GlossyMaterial;
    return std::tuple{Field{"color", &M::colour, Unit::none, Range::zero_to_one,
                            "the fraction of light that the base reflects (linear RGB)"},
                      Field{"roughness", &M::roughness, Unit::none, Range::zero_to_one,
                            "0 for a perfect mirror", true},
                      Field{"index_of_refraction", &M::index_of_refraction, Unit::none,
                            Range::at_least_one, "the coat's; larger values reflect more", true}};
  }
};

/// A body that shines and reflects nothing.
struct EmissiveMaterial {
  Colour radiance = Colour::Ones();

  static constexpr std::string_view name = "emissive";
  static constexpr std::string_view doc =
      "Emits light equally in all directions: any shape as a light.";
  static constexpr auto fields() {
    return std::tuple{Field{"radiance", &EmissiveMaterial::radiance, Unit::none, Range::brightness,
                            "the emitted radiance (linear RGB)"}};
  }
};

/// Glass, water: mirrors and lets through, by Fresnel's law; `absorption` dims what goes through by
/// exp(-absorption * length).
struct DielectricMaterial {
  double index_of_refraction = 1.5;
  double roughness = 0;
  Colour absorption = Colour::Zero();
  double priority = 0;

  static constexpr std::string_view name = "dielectric";
  static constexpr std::string_view doc = "Glass, water: reflects and transmits light.";
  static constexpr auto fields() {
    using M = DielectricMaterial;
    return std::tuple{
        Field{"index_of_refraction", &M::index_of_refraction, Unit::none, Range::at_least_one,
              "of the inside; air has 1", true},
        Field{"roughness", &M::roughness, Unit::none, Range::zero_to_one, "0 for clear glass",
              true},
        Field{"absorption", &M::absorption, Unit::none, Range::not_negative,
              "the absorption per length (linear RGB): exp(-absorption * length) is transmitted",
              true},
        Field{"priority", &M::priority, Unit::none, Range::any,
              "where bodies overlap, the greatest priority counts; among equal ones, the body "
              "entered last",
              true}};
  }
};

/// A metal's complex index of refraction for red, green and blue light, about 650, 550 and 450 nm.
struct Metal {
  std::string_view name;
  std::array<double, 3> eta, k;
};

/// From tables of measured indices (Palik's handbook and refractiveindex.info, as renderers list
/// them).
inline constexpr std::array metals = {
    Metal{"aluminium", {1.657, 0.880, 0.521}, {9.224, 6.269, 4.837}},
    Metal{"chromium", {3.180, 3.180, 2.010}, {3.300, 3.330, 3.060}},
    Metal{"copper", {0.200, 0.924, 1.102}, {3.912, 2.452, 2.142}},
    Metal{"gold", {0.143, 0.375, 1.442}, {3.983, 2.386, 1.603}},
    Metal{"iron", {2.9114, 2.9497, 2.5845}, {3.0893, 2.9318, 2.7670}},
    Metal{"silver", {0.155, 0.117, 0.138}, {4.828, 3.122, 2.147}},
    Metal{"titanium", {2.7407, 2.5418, 2.2370}, {3.8143, 3.4345, 3.0385}},
};

struct MetalNames {
  static constexpr std::string_view what = "a metal";
  static constexpr auto names = [] {
    std::array<std::string_view, metals.size()> of_metals;
    for (std::size_t i = 0; i < metals.size(); ++i) of_metals[i] = metals[i].name;
    return of_metals;
  }();
};
using MetalName = NameOf<MetalNames>;

/// A metal, by its name or by the colour that it mirrors straight ahead.
struct ConductorMaterial {
  MetalName metal;
  PaintIfAny colour;
  double roughness = 0.1;
  double anisotropy = 0;

  static constexpr std::string_view name = "conductor";
  static constexpr std::string_view doc = "A metal: reflects light, transmits none.";
  static constexpr auto fields() {
    using M = ConductorMaterial;
    return std::tuple{
        Field{"metal", &M::metal, Unit::none, Range::any, "the metal", true},
        Field{"color", &M::colour, Unit::none, Range::zero_to_one,
              "instead of the metal: the reflectance at normal incidence (linear RGB)", true},
        Field{"roughness", &M::roughness, Unit::none, Range::zero_to_one, "0 for a perfect mirror",
              true},
        Field{"anisotropy", &M::anisotropy, Unit::none, Range::zero_to_one,
              "roughness across circles around the object's z axis, compared with along them, as "
              "turned on a lathe",
              true}};
  }
};

/// Most things, in layers: what glTF's and robots' materials are made of.
struct PrincipledMaterial {
  Paint colour = Colour::Constant(0.7);
  double metallic = 0;
  double roughness = 0.5;
  double anisotropy = 0;
  double specular = 1;
  double index_of_refraction = 1.5;
  double transmission = 0;
  double coat = 0;
  double coat_roughness = 0;
  double sheen = 0;

  static constexpr std::string_view name = "principled";
  static constexpr std::string_view doc =
      "General material: a clear coat over sheen over a mixture of metal, glass and a glossy base.";
  static constexpr auto fields() {
    using M = PrincipledMaterial;
    return std::tuple{
        Field{"base_color", &M::colour, Unit::none, Range::zero_to_one,
              "of the base, of metal, and of light through glass (linear RGB)"},
        Field{"metallic", &M::metallic, Unit::none, Range::zero_to_one, "the fraction of metal",
              true},
        Field{"roughness", &M::roughness, Unit::none, Range::zero_to_one, "0 for a perfect mirror",
              true},
        Field{"anisotropy", &M::anisotropy, Unit::none, Range::zero_to_one,
              "of metal: as of a conductor", true},
        Field{"specular", &M::specular, Unit::none, Range::zero_to_one,
              "the base's specular reflection, relative to that of its index of refraction", true},
        Field{"index_of_refraction", &M::index_of_refraction, Unit::none, Range::at_least_one,
              "of the base and of glass", true},
        Field{"transmission", &M::transmission, Unit::none, Range::zero_to_one,
              "the fraction of glass in the part that is not metal", true},
        Field{"coat", &M::coat, Unit::none, Range::zero_to_one, "the amount of clear coat", true},
        Field{"coat_roughness", &M::coat_roughness, Unit::none, Range::zero_to_one, "the coat's",
              true},
        Field{"sheen", &M::sheen, Unit::none, Range::zero_to_one,
              "the amount of sheen at grazing angles, as of cloth", true}};
  }
};

/// Paper, a leaf: a sheet that scatters light to both sides. Bodies of it are hollow, flat ones are
/// one sheet.
struct TranslucentMaterial {
  Paint colour = Colour::Constant(0.7);
  double transmission = 0.5;

  static constexpr std::string_view name = "translucent";
  static constexpr std::string_view doc =
      "Paper, a leaf: a thin sheet that scatters light to both sides; bodies of it are hollow.";
  static constexpr auto fields() {
    using M = TranslucentMaterial;
    return std::tuple{Field{"color", &M::colour, Unit::none, Range::zero_to_one,
                            "the fraction of light scattered to both sides together (linear RGB)"},
                      Field{"transmission", &M::transmission, Unit::none, Range::zero_to_one,
                            "the fraction of that which is transmitted", true}};
  }
};

/// Two materials that come before, by their names and their places in Scene::materials.
struct TwoMaterials {
  std::shared_ptr<const std::array<std::string, 2>> names;
  std::array<std::uint32_t, 2> indices = {};
};

/// Two materials in one place.
struct MixMaterial {
  TwoMaterials materials;
  double amount = 0.5;

  static constexpr std::string_view name = "mix";
  static constexpr std::string_view doc = "A mixture of two materials.";
  static constexpr auto fields() {
    using M = MixMaterial;
    return std::tuple{Field{"materials", &M::materials, Unit::none, Range::any,
                            "the names of two materials listed before this one"},
                      Field{"amount", &M::amount, Unit::none, Range::zero_to_one,
                            "the second one's fraction", true}};
  }
};

/// Values of "type" for materials.
using MaterialKind =
    std::variant<LambertMaterial, GlossyMaterial, EmissiveMaterial, DielectricMaterial,
                 ConductorMaterial, PrincipledMaterial, TranslucentMaterial, MixMaterial>;

struct Material {
  std::string name;
  MaterialKind kind;
  Relief relief = {};
  RayKinds visible_to = all_ray_kinds;  ///< as an object's
};

/// True if one of its colours is a texture. The parts of a mixture do not count.
inline bool has_texture(const Material& material) {
  return std::visit(
      []<class M>(const M& kind) {
        if constexpr (std::is_same_v<M, ConductorMaterial>)
          return kind.colour && kind.colour->texture();
        else if constexpr (requires { kind.colour.texture(); })
          return kind.colour.texture() != nullptr;
        else
          return false;
      },
      material.kind);
}

/// True if it has a texture or a relief.
inline bool is_painted(const Material& material) {
  return has_texture(material) || material.relief.any();
}

}  // namespace minkray
