// SPDX-License-Identifier: MIT
// Wavefront of paths that advance together, step by step: ray hits, direct light, and next rays.
#pragma once

#include <optional>

#include "renderer/paths/path_state.h"

namespace minkray {

/// The balance heuristic.
inline double share(double mine, double other) {
  return mine / (mine + other);
}

/// Memory of a wave, which the next one uses again: new pages cost as much as the paths.
struct PathTransport::WaveMemory {
  std::vector<Path> paths;
  std::vector<std::size_t> going_on, scattering, whose, whose_within;
  std::vector<Boundary> boundaries, nexts;
  std::vector<std::optional<Point>> points;
  std::vector<WorldRay> asked, asked_within;
  std::vector<const Inside*> insides;
  std::vector<WorldHit> hits;
  std::vector<std::uint8_t> blocked;
  ShadowRays shadows;
  HalfExtents half_extents;
};

class PathTransport::Wave {
 public:
  Wave(const PathTransport& of, std::span<TracedRay> rays, RayCounts& counts, WaveMemory& memory);
  void run();

 private:
  // Step by step (path_transport.cpp).
  RayKind kind(const Path& path) const {
    return path.depth == 0 ? RayKind::camera : RayKind::indirect;
  }
  /// Finds where the rays of all continuing paths arrive.
  void find_boundaries();
  /// Draws the direction in which the path continues, or ends the path.
  void scatter(Path& path, const Point& point);

  // Arrival of rays (path_arrival.cpp). Returns the medium that counts where bodies overlap:
  // the one of the greatest priority, among equals the one entered last.
  const Medium& medium(const Inside& inside, std::uint32_t* which = nullptr) const;
  static Colour left_after(const Medium& medium, double length);
  /// Light that the ray finds by itself, and the point where it is to be scattered.
  void arrive(std::size_t i);
  /// Adds light that was scattered so often; what the camera sees directly and what is lit directly
  /// is never limited.
  void gather(Path& path, const Colour& light, int depth) const;
  /// Continues through a boundary that does not count, if possible.
  void pass(Path& path, bool can) const;
  /// Light of a path that misses. Surfaces are lit by the environment and mirror it; without one
  /// they still mirror the background that cameras see.
  Colour off_surface(const Path& path);
  void add_emission(Path& path, const Boundary& at, const PreparedMaterial& material) const;

  // Light from lights (path_lights.cpp), one kind for all paths' ends: draw(point, sampler) is a
  // sample of it, and part(point, w, sample) its MIS weight against the surface's own sampling; 0
  // sends no shadow ray.
  template <class Draw, class Part>
  void ask_for(const Draw& draw, const Part& part);
  /// Light from the only direction of a light, which no surface draws.
  void ask_light(std::size_t light);
  /// Light from all around, where it is bright.
  void ask_sky(const SkySource& sky);
  /// Adds what arrives where nothing is in the way.
  void ask_shadows();
  /// Light from one shining body for each path's end, drawn at random. One query decides if the
  /// body is met before anything else.
  void ask_emitters();
  /// Traces a shadow ray within clear bodies.
  void ask_within(const WorldRay& ray, const Inside& inside, Arriving light);
  void add(const Arriving& arriving);

  const PathTransport& of_;
  std::span<TracedRay> rays_;
  RayCounts& counts_;
  const Medium air_;
  std::vector<Path>& paths_;
  std::vector<std::size_t>& going_on_;  ///< the paths that have not ended
  std::vector<Boundary>& boundaries_;   ///< by path: where it has come to
  std::vector<std::optional<Point>>& points_;
  std::vector<std::size_t>& scattering_;  ///< the paths that are at a point
  std::vector<WorldRay>& asked_;
  std::vector<std::size_t>& whose_;
  std::vector<WorldRay>& asked_within_;  ///< rays within clear bodies
  std::vector<std::size_t>& whose_within_;
  std::vector<const Inside*>& insides_;
  std::vector<Boundary>& nexts_;
  std::vector<WorldHit>& hits_;
  std::vector<std::uint8_t>& blocked_;
  ShadowRays& shadows_;
  HalfExtents& half_extents_;
};

}  // namespace minkray
