// SPDX-License-Identifier: MIT
// Places MJCF bodies that have no position under global coordinates: at the centre of mass of their
// geoms, or in the frame of a single geom.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "renderer/import/model/model.h"

namespace minkray {

/// Collects what the geoms of links weigh.
class GeomMasses {
 public:
  /// Begins to collect those of a link.
  void begin(int link) { masses_[link]; }
  bool has(int link) const { return masses_.contains(link); }

  /// Adds a geom of a link that was begun; `mass`, if it is given, instead of the density.
  void add(const ModelGeom& geom, std::optional<double> mass, double density);

  /// The frame in the link's own one; nothing if nothing weighs anything.
  std::optional<Affine<double>> end(int link);

 private:
  struct Weighed {
    double mass;
    Affine<double> pose;
    Vec3<double> centre;  ///< in the link's frame
  };
  std::map<int, std::vector<Weighed>> masses_;
};

/// Moves a link's frame, and leaves where they are its joints and geoms and the links below it.
void move_frame(Model& model, int link, const Affine<double>& frame);

}  // namespace minkray
