// SPDX-License-Identifier: MIT
// Scattering at a surface, for the path tracer: eval is the BSDF times the cosine of w_in, sample
// draws a w_in, pdf is the density of the draws over solid angle. Directions point away from the
// surface, in a frame whose z is the body's outward normal; w_in is on the other side for
// transmitted light.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "renderer/rays/frame.h"
#include "renderer/surfaces/reflection.h"
#include "renderer/surfaces/texture.h"

namespace minkray {

/// Input of a BSDF.
struct Shading {
  Vec3<double> w_out;                   ///< towards where the light goes; z != 0
  double eta_above = 1, eta_below = 1;  ///< indices of refraction outside and inside of the body
  const TexturePoint* place = nullptr;  ///< for textures; none: their mean colours
};

/// The paint's colour there.
inline Colour colour_of(const Paint& paint, const Shading& at) {
  return at.place && paint.texture() ? paint_at(paint, *at.place) : paint.colour();
}

struct BsdfSample {
  Vec3<double> w_in;
  Colour weight;  ///< eval / pdf
  double pdf;     ///< of w_in, where it has one
  /// The only direction of its kind, as of a smooth mirror: drawn with a chance, not a density.
  bool is_sharp = false;
};

/// Three numbers in [0, 1): a pair, and one to choose by.
struct BsdfChoice {
  std::array<double, 2> u;
  double which;
};

class Bsdf {
 public:
  virtual ~Bsdf() = default;

  virtual Colour eval(const Shading& at, const Vec3<double>& w_in) const = 0;
  virtual double pdf(const Shading& at, const Vec3<double>& w_in) const = 0;
  /// Nothing where the light is absorbed.
  virtual std::optional<BsdfSample> sample(const Shading& at, const BsdfChoice& choice) const = 0;

  /// True if all directions are sharp, so no light arrives from a light's direction.
  virtual bool is_sharp() const { return false; }
  /// True if light enters the body.
  virtual bool lets_through() const { return false; }
  /// True if the direction of x matters: it then points along circles around the object's z axis.
  virtual bool has_grain() const { return false; }
};

/// The material must be plain, not a mixture.
std::unique_ptr<const Bsdf> make_bsdf(const Material& material);

}  // namespace minkray
