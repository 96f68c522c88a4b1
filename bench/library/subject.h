// SPDX-License-Identifier: MIT
// The scenes that are measured: objects of one shape, or of eight in turn, at random places of a
// cube, turned at random. Shapes and densities are those of `minkray generate`.
#pragma once

#include <string>
#include <vector>

#include "body.h"

namespace bench {

struct Placed {
  std::size_t body;
  mk::Pose pose;
};

struct Subject {
  std::vector<Body> bodies;
  std::vector<Placed> objects;
  double half_size;  ///< of the cube that their middles lie in

  double least_radius() const;
};

/// `kind`: "rounded boxes", "spheres", "ellipsoids", "hulls of 16", "hulls of 64", "eight kinds".
Subject make_subject(const std::string& kind, std::size_t objects);

/// A scene of the library with these objects, committed.
mk::Scene scene_of(const Subject& subject);

}  // namespace bench
