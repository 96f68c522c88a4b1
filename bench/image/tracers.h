// SPDX-License-Identifier: MIT
// The tracers that are measured, each made from a scene: making one is the building that is timed.
#pragma once

#include "bench/image/mesh_of_shapes.h"
#include "bench/image/tracer.h"
#include "renderer/scene/scene.h"

namespace minkray::bench {

/// Minkray's world: exact shapes.
std::unique_ptr<Tracer> exact_shapes(const Scene& scene, BvhBuild build = BvhBuild::quality);

/// Embree on instances of triangle meshes, one mesh for each of the scene's shapes; the meshes'
/// hierarchies at its highest quality, which is slow to build, or at its default.
std::unique_ptr<Tracer> embree_triangles(const Scene& scene, const Meshes& meshes,
                                         bool highest_quality, int threads);

/// Embree on user geometry: its hierarchy over the boxes of our instances, and in it our cast of
/// one ray at one shape.
std::unique_ptr<Tracer> embree_with_our_cast(const Scene& scene, int threads);

/// True if all shapes of a scene are rounded boxes.
bool has_closed_form(const Scene& scene);

/// Embree's own spheres or round curves, where all shapes of a scene are spheres, or all capsules.
bool has_round_geometry(const Scene& scene);
std::unique_ptr<Tracer> embree_round(const Scene& scene, int threads);

/// This one uses the closed form of a ray and a rounded box.
std::unique_ptr<Tracer> embree_with_closed_form(const Scene& scene, int threads);

}  // namespace minkray::bench
