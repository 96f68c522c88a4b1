// SPDX-License-Identifier: MIT
// Textures of scene files: one struct per texture; the list of all is at the end. Shapes need no
// parametrisation: a texture is a function of the point in the object's frame, or of a mapping of
// that point to a plane.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "core/math/vec.h"
#include "core/support/field.h"
#include "renderer/scene/named.h"

namespace minkray {

/// Linear RGB.
using Colour = Vec3<double>;

/// Maps points to a plane. Every convex body is star-shaped around an interior point, so the
/// direction from that point identifies each surface point.
struct Mappings {
  static constexpr std::string_view what = "a mapping";
  static constexpr std::array<std::string_view, 5> names = {"radial", "box", "planar", "normal",
                                                            "uv"};
};
using Mapping = NameOf<Mappings>;

namespace texture_doc {
inline constexpr std::string_view scale =
    "the length of one repeat; in turns for the mappings radial and normal, in texture coordinates "
    "for uv";
inline constexpr std::string_view mapping =
    "radial: by longitude and latitude around the object's origin; box: along the axis that the "
    "surface faces most; planar: along z; normal: by the normal's longitude and latitude; uv: by a "
    "mesh's texture coordinates; by default by position in space";
}  // namespace texture_doc

struct ImageTexture {
  PictureFile picture;
  Mapping mapping = {"radial"};
  double scale = 1;
  Colour tint = Colour::Ones();

  static constexpr std::string_view name = "image";
  static constexpr std::string_view doc = "A picture: .exr and .hdr linear, .png and .jpg in sRGB.";
  static constexpr auto fields() {
    using T = ImageTexture;
    return std::tuple{
        Field{"file", &T::picture, Unit::none, Range::any, "the picture's file"},
        Field{"mapping", &T::mapping, Unit::none, Range::any, texture_doc::mapping, true},
        Field{"scale", &T::scale, Unit::length, Range::positive, texture_doc::scale, true},
        Field{"tint", &T::tint, Unit::none, Range::zero_to_one,
              "a colour that multiplies the picture's", true}};
  }
};

/// Parameters of all textures with two colours.
struct TwoColours {
  Colour a = Colour::Constant(0.8), b = Colour::Constant(0.15);
  double scale = 1;
  Mapping mapping;
};

template <class T>
constexpr auto two_colour_fields() {
  return std::tuple{
      Field<T, Colour>{"a", &T::a, Unit::none, Range::zero_to_one, "the first colour", true},
      Field<T, Colour>{"b", &T::b, Unit::none, Range::zero_to_one, "the second colour", true},
      Field<T, double>{"scale", &T::scale, Unit::length, Range::positive, texture_doc::scale, true},
      Field<T, Mapping>{"mapping", &T::mapping, Unit::none, Range::any, texture_doc::mapping,
                        true}};
}

struct CheckerTexture : TwoColours {
  static constexpr std::string_view name = "checker";
  static constexpr std::string_view doc = "A checkerboard of two colours, or cubes.";
  static constexpr auto fields() { return two_colour_fields<CheckerTexture>(); }
};

struct GridTexture : TwoColours {
  double width = 0.05;

  static constexpr std::string_view name = "grid";
  static constexpr std::string_view doc = "Lines of colour b on colour a.";
  static constexpr auto fields() {
    return std::tuple_cat(two_colour_fields<GridTexture>(),
                          std::tuple{Field<GridTexture, double>{
                              "width", &GridTexture::width, Unit::none, Range::zero_to_one,
                              "of the lines, as a fraction of the scale", true}});
  }
};

struct GradientTexture : TwoColours {
  Vec3<double> direction = {0, 0, 1};

  static constexpr std::string_view name = "gradient";
  static constexpr std::string_view doc =
      "From colour a to colour b along a direction, over a length of `scale` around the origin.";
  static constexpr auto fields() {
    return std::tuple_cat(two_colour_fields<GradientTexture>(),
                          std::tuple{Field<GradientTexture, Vec3<double>>{
                              "direction", &GradientTexture::direction, Unit::none, Range::any,
                              "from a to b; of any length", true}});
  }
};

struct NoiseTexture : TwoColours {
  static constexpr std::string_view name = "noise";
  static constexpr std::string_view doc = "Clouds of two colours: noise of several sizes.";
  static constexpr auto fields() { return two_colour_fields<NoiseTexture>(); }
};

struct MarbleTexture : TwoColours {
  static constexpr std::string_view name = "marble";
  static constexpr std::string_view doc = "Veins of colour b in colour a.";
  static constexpr auto fields() { return two_colour_fields<MarbleTexture>(); }
};

struct WoodTexture : TwoColours {
  static constexpr std::string_view name = "wood";
  static constexpr std::string_view doc = "Rings of two colours around the object's z axis.";
  static constexpr auto fields() { return two_colour_fields<WoodTexture>(); }
};

/// Values of "type" for textures.
using TextureKind = std::variant<ImageTexture, CheckerTexture, GridTexture, GradientTexture,
                                 NoiseTexture, MarbleTexture, WoodTexture>;

/// A colour, the same everywhere or not.
class Paint {
 public:
  template <class E>
  requires std::is_convertible_v<const E&, Colour> Paint(const E& colour) : colour_(colour) {}
  Paint(double red, double green, double blue) : colour_(red, green, blue) {}
  explicit Paint(TextureKind texture);

  /// About the mean of a texture's colours.
  const Colour& colour() const { return colour_; }
  /// Null if it is the same everywhere.
  const TextureKind* texture() const { return texture_ ? &texture_->kind : nullptr; }
  /// The picture of a texture that has one, at smaller sizes (smaller_images).
  const std::vector<Image>& smaller() const { return texture_->smaller; }

 private:
  struct Texture {
    TextureKind kind;
    std::vector<Image> smaller;
  };
  Colour colour_;
  std::shared_ptr<const Texture> texture_;
};

/// A colour, or none.
class PaintIfAny {
 public:
  PaintIfAny() = default;
  PaintIfAny(std::nullopt_t) {}
  template <class P>
  requires std::is_convertible_v<const P&, Paint> PaintIfAny(const P& paint)
      : paint_(std::make_shared<const Paint>(paint)) {}

  bool has_value() const { return paint_ != nullptr; }
  explicit operator bool() const { return has_value(); }
  const Paint& operator*() const { return *paint_; }
  const Paint* operator->() const { return paint_.get(); }
  Paint value_or(const Paint& other) const { return paint_ ? *paint_ : other; }

 private:
  std::shared_ptr<const Paint> paint_;
};

}  // namespace minkray
