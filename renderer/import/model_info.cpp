// SPDX-License-Identifier: MIT
#include "renderer/import/model_info.h"

#include <cstdio>
#include <map>

#include "core/files/text.h"
#include "renderer/import/model/mesh_hull.h"
#include "renderer/json/mistakes.h"

namespace minkray {
namespace {

/// Convex but for rounding: distances of the hull and the mesh are at most this share of the size,
/// and volumes differ by at most this share.
constexpr double convex_enough = 1e-6;

std::string line(std::string_view title, const std::string& value) {
  std::string text(title);
  text.resize(std::max<std::size_t>(text.size(), 12), ' ');
  return text + value + "\n";
}

using Counts = std::map<std::string, std::size_t>;

/// Counts of each kind.
struct ModelCounts {
  explicit ModelCounts(const Model& model) {
    for (const ModelLink& link : model.links)
      for (const ModelJoint& joint : link.joints) ++joints[std::string(name_of(joint.kind))];
    for (const ModelGeom& geom : model.geoms) {
      ++geoms[geom.kind];
      collide += geom.collides ? 1 : 0;
      seen += geom.is_seen ? 1 : 0;
    }
  }
  Counts joints, geoms;
  std::size_t collide = 0, seen = 0;
};

Json json_of(const Counts& counts) {
  Json json = Json::object();
  for (const auto& [name, count] : counts) json[printable(name, 100)] = count;
  return json;
}

/// "; 12 triangles, closed", and what is odd about them.
std::string surface_as_text(const MeshFacts& facts) {
  if (facts.triangles == 0) return "";
  std::string text = "; " + std::to_string(facts.triangles) + " triangles, ";
  text += facts.is_closed()       ? "closed"
          : facts.open_edges == 0 ? "no area"
                                  : std::to_string(facts.open_edges) + " open edges";
  if (facts.without_area > 0) text += ", " + std::to_string(facts.without_area) + " without area";
  if (facts.repeated > 0) text += ", " + std::to_string(facts.repeated) + " repeated";
  return text;
}

/// "convex", or how much larger the hull is.
std::string hull_as_text(const ModelMesh& mesh, const MeshFacts& facts) {
  const double larger = std::max(facts.overshoot, facts.deepest);
  const double share = mesh.diameter > 0 ? larger / mesh.diameter : 0;
  if (share <= convex_enough && facts.missing_volume > convex_enough)
    return "not convex: its hull has more volume";
  if (share <= convex_enough) return facts.is_flat ? "flat" : "convex";
  char text[100];
  std::snprintf(text, sizeof text, "convex hull up to %.3g (%.2g %%) larger than the mesh", larger,
                100 * share);
  return text;
}

std::string counted(const std::map<std::string, std::size_t>& counts) {
  if (counts.empty()) return "none";
  return listed(counts, [](const auto& one) {
    return std::to_string(one.second) + " " + printable(one.first, 40);
  });
}

}  // namespace

std::string meshes_as_text(const std::vector<ModelMesh>& meshes) {
  std::string text;
  for (const ModelMesh& mesh : meshes) {
    const MeshFacts facts = facts_of(mesh);
    const std::size_t parts = mesh.parts.size();
    text += line("mesh", printable(mesh.file, 80) + ": " + std::to_string(mesh.vertices) +
                             " vertices, " + std::to_string(facts.hull_points) + " of " +
                             (parts > 1 ? std::to_string(parts) + " hulls" : "the hull") + "; " +
                             hull_as_text(mesh, facts) + surface_as_text(facts));
  }
  return text;
}

Json meshes_as_json(const std::vector<ModelMesh>& meshes) {
  Json list = Json::array();
  for (const ModelMesh& mesh : meshes) {
    Json one;
    const MeshFacts facts = facts_of(mesh);
    one["file"] = printable(mesh.file);
    one["vertices"] = mesh.vertices;
    one["hulls"] = mesh.parts.size();
    one["hull_points"] = facts.hull_points;
    one["size"] = mesh.diameter;
    one["deepest_vertex"] = facts.deepest;
    if (facts.triangles > 0) {
      one["triangles"] = facts.triangles;
      one["hull_overshoot"] = facts.overshoot;
      one["is_closed"] = facts.is_closed();
      one["open_edges"] = facts.open_edges;
      one["triangles_without_area"] = facts.without_area;
      one["repeated_triangles"] = facts.repeated;
    }
    list.push_back(std::move(one));
  }
  return list;
}

std::string model_as_text(const Model& model) {
  std::string text = line("model", model.format + " " + printable(model.name, 80));
  const ModelCounts counts(model);
  text += line("links", std::to_string(model.links.size()));
  text += line("joints", counted(counts.joints));
  text += line("shapes", counted(counts.geoms) + " (" + std::to_string(counts.seen) + " visual, " +
                             std::to_string(counts.collide) + " collision)");
  if (!model.keyframes.empty())
    text += line("keyframes", listed(keyframe_names(model),
                                     [](const std::string& name) { return printable(name, 40); }));
  text += meshes_as_text(model.meshes);
  for (const PassedOver& one : model.passed_over)
    text += line("skipped", std::to_string(one.count) + " " + one.what + ": " + one.why);
  return text;
}

Json model_as_json(const Model& model) {
  const ModelCounts counts(model);
  Json json;
  json["format"] = model.format;
  json["name"] = printable(model.name);
  json["links"] = model.links.size();
  json["joints"] = json_of(counts.joints);
  json["geoms"] = json_of(counts.geoms);
  json["seen"] = counts.seen;
  json["collide"] = counts.collide;
  json["keyframes"] = Json::array();
  for (const std::string& name : keyframe_names(model))
    json["keyframes"].push_back(printable(name));
  json["meshes"] = meshes_as_json(model.meshes);
  json["passed_over"] = Json::array();
  for (const PassedOver& passed : model.passed_over) {
    Json one;
    one["what"] = printable(passed.what);
    one["why"] = printable(passed.why);
    one["count"] = passed.count;
    json["passed_over"].push_back(std::move(one));
  }
  return json;
}

}  // namespace minkray
