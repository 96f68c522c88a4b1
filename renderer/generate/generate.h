// SPDX-License-Identifier: MIT
// Benchmark scenes with any number of shapes, bit-identical for the same seed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace minkray {

struct GeneratedKind {
  std::string_view name;
  std::string_view doc;
};

inline constexpr GeneratedKind generated_kinds[] = {
    {"rounded-boxes", "rounded boxes at random poses; some overlap"},
    {"spheres", "equal spheres at random positions"},
    {"ellipsoids", "densely packed rotated ellipsoids that do not overlap"},
    {"hulls", "a grid of different convex hulls"},
    {"capsules", "thin capsules at random poses"},
    {"tumbling", "bodies of six different shapes, which fly apart; animated for two seconds"},
};

struct GenerateOptions {
  std::string_view kind;
  std::size_t count = 1000;
  std::uint64_t seed = 0;
};

/// Hulls are points in the scene file itself, each hull its own; a file of more could not be read.
inline constexpr std::size_t most_generated_hulls = 100000;

/// Up to this number, poses are written into the scene file; more go into a file next to it.
inline constexpr std::size_t most_inline_poses = 1000;

/// Writes the scene file and, if there are many poses, first their file next to it: of the same
/// name, but ending in .f32. Each is there in full or not at all. Throws CannotWrite, and
/// WrongUsage if the kind is unknown or the count not possible.
void generate_scene(const GenerateOptions& options, const std::string& file);

}  // namespace minkray
