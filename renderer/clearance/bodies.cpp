// SPDX-License-Identifier: MIT
#include "renderer/clearance/bodies.h"

#include "renderer/import/scene_of_model.h"

namespace minkray {
namespace {

const Shape<double> nothing = Point<double>();

}  // namespace

std::vector<ClearanceBody> bodies_of(const Model& model, GeometryChoice geometry) {
  std::vector<ClearanceBody> bodies;
  const std::vector<bool> wanted = chosen_geoms(model, geometry);
  for (std::size_t i = 0; i < model.geoms.size(); ++i) {
    const ModelGeom& geom = model.geoms[i];
    if (!wanted[i]) continue;
    const std::string link =
        geom.link < 0 ? "" : model.links[static_cast<std::size_t>(geom.link)].name;
    const std::string name =
        !geom.name.empty() ? geom.name : (link.empty() ? "world" : link) + "/" + geom.kind;
    // The map to the link's frame may scale: it becomes part of the shape.
    bodies.push_back(
        {name, link, geom.link, {}, ContactShape(geom.shape ? *geom.shape : nothing, geom.pose)});
    if (!geom.shape) bodies.back().half_space = HalfSpaceBody<double>().posed(geom.pose);
  }
  return bodies;
}

std::vector<ClearanceBody> bodies_of(const Scene& scene) {
  std::vector<ClearanceBody> bodies;
  for (const Object& object : scene.objects) {
    bodies.push_back({object.name, "", -1, {}, ContactShape(object.shape, object.pose)});
    if (object.half_space) bodies.back().half_space = object.half_space->posed(object.pose);
  }
  return bodies;
}

std::vector<BodyPair> pairs_of(const std::vector<ClearanceBody>& bodies, const Model& model,
                               const AllowedPairs& allowed, bool self) {
  const std::vector<int> groups = rigid_groups(model);
  const auto group = [&](const ClearanceBody& body) {
    return body.link_index < 0 ? -1 : groups[static_cast<std::size_t>(body.link_index)];
  };
  // The group that a group hangs on; of the world, and of what is fixed to it, there is none.
  const auto parent = [&](int of) {
    const int link = of < 0 ? -1 : model.links[static_cast<std::size_t>(of)].parent;
    return link < 0 ? -2 : groups[static_cast<std::size_t>(link)];
  };
  const auto is_still = [&](int of) {
    if (of < 0) return true;
    const ModelLink& link = model.links[static_cast<std::size_t>(of)];
    return link.parent < 0 && std::ranges::all_of(link.joints, [](const ModelJoint& joint) {
             return joint.kind == JointKind::fixed;
           });
  };
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      const ClearanceBody &a = bodies[i], &b = bodies[j];
      const int of_a = group(a), of_b = group(b);
      if (of_a == of_b || (is_still(of_a) && is_still(of_b))) continue;
      const bool is_self = of_a >= 0 && of_b >= 0;
      if (is_self && (!self || parent(of_a) == of_b || parent(of_b) == of_a)) continue;
      if (is_self && allowed.allows(a.link, b.link)) continue;
      pairs.push_back({i, j});
    }
  return pairs;
}

}  // namespace minkray
