// SPDX-License-Identifier: MIT
// Proves results about whole scenes: the named object is hit, and no other one before it.
#pragma once

#include <optional>
#include <vector>

#include "core/math/bounds.h"
#include "core/proof/check_certificate.h"
#include "renderer/library/handles/held_scene.h"

namespace minkray {

/// Refers to the scene, which must be committed. Any number of threads may call it.
class Prover {
 public:
  explicit Prover(const HeldScene& scene);

  minkray_proof prove(const Ray<double>& ray, const minkray_hit& hit) const;

 private:
  /// One instance in the world, or one part of a compound.
  struct Body {
    std::uint32_t object = 0;
    bool is_removed = false;
    std::optional<Shape> shape;  ///< none: a half-space or mesh
    std::optional<PosedMesh> mesh;
    HalfSpaceBody<double> half_space;
    Bounds<double> bounds;
    std::vector<std::shared_ptr<const CustomSupport>> customs;
  };

  CertificateVerdict verdict(const Body& body, const Ray<double>& ray, const Claim& claim,
                             Certificate* found) const;
  /// True if the ray is proven not to hit the body before t_lo.
  bool keeps_off(const Body& body, const Ray<double>& ray, double t_lo) const;
  /// The body with the number in the hit; null if no body has this number.
  const Body* body_of(const minkray_hit& hit) const;

  const World& world_;
  std::vector<Body> bodies_;
  std::vector<std::size_t> first_;  ///< index of each object's first body, and the number of bodies
};

}  // namespace minkray
