// SPDX-License-Identifier: MIT
#include "renderer/plan/workcell.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "renderer/base/errors.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/json/object_reader.h"

namespace minkray {
namespace {

/// Pose of a frame in the world; nothing if no frame has that name.
std::optional<Affine<double>> frame_of(const std::string& name, const PlanningScene& scene,
                                       const Model& model,
                                       const std::vector<Affine<double>>& links) {
  if (const auto fixed = scene.fixed_frames.find(name); fixed != scene.fixed_frames.end())
    return fixed->second;
  if (const int link = find_link(model, name); link >= 0)
    return links[static_cast<std::size_t>(link)];
  if (name.empty() || name == "world" || name == "map") return Affine<double>();
  return std::nullopt;
}

/// Names an object's shapes.
void name_geoms(const std::string& id, std::vector<ModelGeom>& geoms) {
  for (std::size_t i = 0; i < geoms.size(); ++i)
    geoms[i].name = geoms.size() == 1 ? id : id + "/" + std::to_string(i + 1);
}

/// Flips a half-space if the point is not on its free side.
void face(ModelGeom& plane, const Vec3<double>& point) {
  const Vec3<double> normal = plane.pose.linear.col(2);
  constexpr double on_it = 1e-9;  // metres
  if (normal.dot(point - plane.pose.translation) >= -on_it) return;
  plane.pose.linear.col(1) *= -1;
  plane.pose.linear.col(2) *= -1;
}

/// Owner of each body of the model. Objects' shapes are the model's last ones, in order
/// (add_to_model); by names alone the shape 1 of an object "a" would be an object "a/1".
std::vector<std::string> owners_of(const Workcell& cell, const PlanningScene* planning) {
  std::vector<std::string> of_shapes;
  if (planning)
    for (const auto* objects : {&planning->objects, &planning->attached})
      for (const PlannedObject& object : *objects)
        of_shapes.insert(of_shapes.end(), object.geoms.size(), object.id);
  const std::vector<bool> wanted = chosen_geoms(cell.model, cell.geometry);
  const std::size_t first = wanted.size() - of_shapes.size();
  std::vector<std::string> owners;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    const ClearanceBody& body = cell.bodies[owners.size()];
    owners.push_back(body.link_index >= 0 ? body.link
                     : i >= first         ? of_shapes[i - first]
                                          : body.name.substr(0, body.name.find('/')));
  }
  return owners;
}

class PairRules {
 public:
  PairRules(const Workcell& cell, const PlanningScene* planning, const AllowedPairs& allowed,
            const WorkcellOptions& options)
      : cell_(cell), planning_(planning), allowed_(allowed), options_(options) {
    const std::vector<int> groups = rigid_groups(cell.model);
    for (const ClearanceBody& body : cell.bodies)
      places_.push_back(place_of(body.link_index, cell.model, groups));
    if (!planning) return;
    for (const PlannedObject& object : planning->attached) carried_.emplace(object.id, &object);
  }

  bool are_pair(std::size_t i, std::size_t k) const {
    const LinkPlace &a = places_[i], &b = places_[k];
    const bool are_links = a.group >= 0 && b.group >= 0;
    if (are_links && options_.only_obstacles) return false;
    if (!are_links && a.group < 0 && b.group < 0) return false;
    const std::string &of_a = cell_.owners[i], &of_b = cell_.owners[k];
    const auto carried_a = carried_.find(of_a), carried_b = carried_.find(of_b);
    const bool is_carried = carried_a != carried_.end() || carried_b != carried_.end();
    // A carried object is not part of the link that carries it: it may hit that link's neighbours.
    if (is_carried ? a.group == b.group || (a.is_still && b.is_still) : !are_looked_at(a, b))
      return false;
    const auto touches = [](const auto& carried, const auto& end, const std::string& other) {
      return carried != end && carried->second->touch_links.contains(other);
    };
    if (touches(carried_a, carried_.end(), of_b) || touches(carried_b, carried_.end(), of_a))
      return false;
    if (planning_ && !planning_->matrix.empty()) return !planning_->matrix.allows(of_a, of_b);
    return !are_links || !allowed_.allows(of_a, of_b);
  }

  /// Padding applies between links and obstacles, not between links, as in MoveIt.
  double margin(std::size_t i, std::size_t k) const {
    if (places_[i].group >= 0 && places_[k].group >= 0) return 0;
    return padding_of(places_[i].group >= 0 ? i : k);
  }

 private:
  double padding_of(std::size_t body) const {
    const std::string& name = cell_.owners[body];
    if (const auto found = options_.inflate.find(name); found != options_.inflate.end())
      return found->second;
    if (options_.padding > 0 || !planning_) return options_.padding;
    const auto found = planning_->padding.find(name);
    return found == planning_->padding.end() ? 0 : found->second;
  }

  const Workcell& cell_;
  const PlanningScene* planning_;
  const AllowedPairs& allowed_;
  const WorkcellOptions& options_;
  std::vector<LinkPlace> places_;
  std::unordered_map<std::string, const PlannedObject*> carried_;
};

}  // namespace

void add_to_model(const PlanningScene& scene, Model& model, Mistakes& mistakes) {
  Model posed = model;
  for (const auto& [name, values] : scene.state)
    if (ModelJoint* joint = find_joint(posed, name)) joint->value = values;
  follow_mimics(posed);
  const std::vector<Affine<double>> links = link_poses(posed);
  std::vector<std::string> names;
  for (const ModelLink& link : model.links) names.push_back(link.name);
  for (const PlannedObject& object : scene.objects) {
    if (!scene.matrix.empty() && find_link(model, object.id) >= 0)
      mistakes.add(
          "object \"" + printable(object.id, 60) +
          "\": id: must not be the name of a link: allowed_collision_matrix has names only");
    const auto frame = frame_of(object.frame, scene, posed, links);
    if (!frame) {
      mistakes.add("object \"" + printable(object.id, 60) + "\": frame_id: no frame is named \"" +
                   printable(object.frame, 60) + "\" (" + suggestion(object.frame, names) + ")");
      continue;
    }
    std::vector<ModelGeom> geoms = object.geoms;
    name_geoms(object.id, geoms);
    for (ModelGeom& geom : geoms) {
      geom.pose = *frame * geom.pose;
      geom.rgba = {0.62, 0.6, 0.5, 1};
      if (!geom.shape && !geom.mesh)
        face(geom, links.empty() ? Vec3<double>::Zero() : links[0].translation);
      model.geoms.push_back(std::move(geom));
    }
  }
  for (const PlannedObject& object : scene.attached) {
    // Pairs are allowed by name.
    if (find_link(model, object.id) >= 0 ||
        std::ranges::find(scene.objects, object.id, &PlannedObject::id) != scene.objects.end()) {
      mistakes.add("attached object \"" + printable(object.id, 60) +
                   "\": id: must not be the name of a link or of another object");
      continue;
    }
    const int parent = find_link(model, object.carrier);
    if (parent < 0) {
      mistakes.add("attached object \"" + printable(object.id, 60) +
                   "\": link_name: there is no link \"" + printable(object.carrier, 60) + "\" (" +
                   suggestion(object.carrier, names) + ")");
      continue;
    }
    const auto frame = frame_of(object.frame, scene, posed, links);
    if (!frame) {
      mistakes.add("attached object \"" + printable(object.id, 60) +
                   "\": frame_id: no frame is named \"" + printable(object.frame, 60) + "\"");
      continue;
    }
    ModelLink link;
    link.name = object.id;
    link.parent = parent;
    link.joints.emplace_back();
    std::vector<ModelGeom> geoms = object.geoms;
    name_geoms(object.id, geoms);
    for (ModelGeom& geom : geoms) {
      if (!geom.shape && !geom.mesh)
        mistakes.add("attached object \"" + printable(object.id, 60) + "\": must have no planes");
      // The link carries it from its place in the scene's state.
      if (object.frame != object.carrier)
        geom.pose = links[static_cast<std::size_t>(parent)].inverse() * *frame * geom.pose;
      geom.link = static_cast<int>(model.links.size());
      geom.rgba = {0.75, 0.62, 0.3, 1};
      model.geoms.push_back(std::move(geom));
    }
    model.links.push_back(std::move(link));
  }
}

Workcell workcell_of(Model model, std::vector<Scene> scenes, const PlanningScene* planning,
                     const AllowedPairs& allowed, const WorkcellOptions& options) {
  Workcell cell{std::move(model), std::move(scenes), {}, {}, {}, options.geometry};
  cell.bodies = bodies_of(cell.model, options.geometry);
  cell.owners = owners_of(cell, planning);
  for (const Scene& scene : cell.scenes)
    for (ClearanceBody& body : bodies_of(scene)) {
      cell.owners.push_back(body.name);
      cell.bodies.push_back(std::move(body));
    }
  const PairRules rules(cell, planning, allowed, options);
  std::vector<std::size_t> links;
  for (std::size_t i = 0; i < cell.bodies.size(); ++i)
    if (cell.bodies[i].link_index >= 0) links.push_back(i);
  for (std::size_t i = 0; i < cell.bodies.size(); ++i) {
    const bool is_link = cell.bodies[i].link_index >= 0;
    for (const std::size_t k : links) {
      if ((is_link && k <= i) || !rules.are_pair(i, k)) continue;
      if (cell.pairs.size() == most_pairs)
        throw BadInput("more than 10,000,000 pairs of bodies move against each other");
      cell.pairs.push_back({std::min(i, k), std::max(i, k), rules.margin(i, k)});
    }
  }
  return cell;
}

}  // namespace minkray
