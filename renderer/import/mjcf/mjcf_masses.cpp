// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf/mjcf_masses.h"

#include "renderer/import/model/hull_mass.h"
#include "renderer/import/model/mesh_hull.h"

namespace minkray {

void GeomMasses::add(const ModelGeom& geom, std::optional<double> mass, double density) {
  const Mass of_shape = volume_of(geom.mesh ? hull_of(*geom.mesh) : *geom.shape);
  masses_[geom.link].push_back(
      {mass.value_or(density * of_shape.volume), geom.pose, geom.pose(of_shape.centre)});
}

std::optional<Affine<double>> GeomMasses::end(int link) {
  const std::vector<Weighed> masses = std::move(masses_[link]);
  masses_.erase(link);
  double sum = 0;
  Vec3<double> moment = Vec3<double>::Zero();
  for (const Weighed& one : masses) {
    sum += one.mass;
    moment += one.mass * one.centre;
  }
  if (!(sum > 0)) return std::nullopt;
  Affine<double> frame;
  if (masses.size() == 1) frame.linear = masses[0].pose.linear;
  frame.translation = moment / sum;
  return frame;
}

void move_frame(Model& model, int link, const Affine<double>& frame) {
  const Affine<double> back = frame.inverse();
  const auto index = static_cast<std::size_t>(link);
  ModelLink& moved = model.links[index];
  moved.rest = moved.rest * frame;
  for (ModelJoint& joint : moved.joints) {
    joint.axis = back.linear * joint.axis;
    joint.anchor = back(joint.anchor);
  }
  // The geoms of this link and those of the links below it were added last.
  for (std::size_t i = model.geoms.size(); i-- > 0 && model.geoms[i].link >= link;)
    if (model.geoms[i].link == link) model.geoms[i].pose = back * model.geoms[i].pose;
  for (std::size_t i = index + 1; i < model.links.size(); ++i)
    if (model.links[i].parent == link) model.links[i].rest = back * model.links[i].rest;
}

}  // namespace minkray
