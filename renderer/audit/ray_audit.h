// SPDX-License-Identifier: MIT
// Proves every result of a picture's rays by certificates (core/proof/certificate.h), object by
// object, without the BVH. A ray that hits needs a proof of its first hit and of a miss at every
// object before; a ray that misses, a miss at all objects; a blocked shadow ray, one hit. All else
// counts as a failure.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/proof/check_certificate.h"
#include "renderer/rays/ray_observer.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// One answer without proof.
struct AuditFailure {
  std::string message;
  std::string query;  ///< a line for `minkray cast`
};

/// Refers to scene and world, object by object. Any number of threads may call it.
class RayAudit final : public RayObserver {
 public:
  RayAudit(const Scene& scene, const World& world);

  void closest(RayKind kind, const Ray<double>& ray, std::uint32_t skip,
               const WorldHit& answer) override;
  void occluded(RayKind kind, const Ray<double>& ray, std::uint32_t skip, bool answer) override;

  std::uint64_t rays(RayKind kind) const { return rays_[index(kind)]; }
  std::uint64_t failed(RayKind kind) const { return failed_[index(kind)]; }
  std::uint64_t certificates() const { return certificates_; }
  /// The first few.
  const std::vector<AuditFailure>& failures() const { return failures_; }

 private:
  struct Target {
    Shape shape;  ///< in the world's frame
    Bounds<double> bounds;
    std::optional<HalfSpaceBody<double>> half_space =
        {};  ///< if there is one, in the place of both
    std::optional<PosedMesh> mesh = {};
  };
  static std::size_t index(RayKind kind) { return static_cast<std::size_t>(kind); }
  CertificateVerdict verdict(std::uint32_t instance, const Ray<double>& ray, std::uint32_t skip,
                             const Claim& claim);
  bool is_ignored(std::uint32_t instance, std::uint32_t skip) const;
  bool may_meet(RayKind kind, std::uint32_t instance, const Ray<double>& ray) const;
  bool all_missed(RayKind kind, const Ray<double>& ray, std::uint32_t skip, std::uint32_t met);
  void fail(RayKind kind, std::uint32_t instance, const Ray<double>& ray, std::string_view what);

  const Scene& scene_;
  const World& world_;
  std::vector<Target> targets_;
  std::array<std::atomic<std::uint64_t>, 4> rays_{}, failed_{};
  std::atomic<std::uint64_t> certificates_ = 0;
  std::mutex mutex_;
  std::vector<AuditFailure> failures_;
};

}  // namespace minkray
