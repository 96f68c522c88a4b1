// SPDX-License-Identifier: MIT
// The rays that are cast at scenes. Their numbers are floats, so that every library gets the same.
#pragma once

#include <vector>

#include "subject.h"

namespace bench {

/// Rays of a square picture of side x side pixels, in blocks of 8 x 8 that are made of blocks of
/// 4 x 2. The camera sees the whole cube from above one of its edges.
std::vector<mk::Ray> camera_rays(const Subject& subject, int side);

/// Rays from where others arrived, begun a little above the surface.
/// Scattered: to all sides with the density of the cosine, in random order; about `count` of them.
std::vector<mk::Ray> scattered_rays(const Subject& subject, const std::vector<mk::Ray>& rays,
                                    const std::vector<mk::Hit>& hits, std::size_t count);
/// Towards a light that is far away, in the order of the rays.
std::vector<mk::Ray> light_rays(const Subject& subject, const std::vector<mk::Ray>& rays,
                                const std::vector<mk::Hit>& hits);

}  // namespace bench
