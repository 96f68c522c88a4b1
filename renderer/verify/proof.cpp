// SPDX-License-Identifier: MIT
#include "renderer/verify/proof.h"

#include <algorithm>
#include <set>

#include "core/files/regular_file.h"
#include "renderer/base/errors.h"
#include "renderer/import/model/mesh_hull.h"
#include "renderer/json/number_json.h"
#include "renderer/verify/sha256.h"

namespace minkray {
namespace {

constexpr std::size_t most_file_bytes = std::size_t{1} << 30;

Json numbers_json(const Mat3<double>& m) {
  Json list = Json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) list.push_back(m(row, column));
  return list;
}

Json links_json(const Model& model) {
  Json links = Json::array();
  for (const ModelLink& link : model.links) {
    Json joints = Json::array();
    for (const ModelJoint& joint : link.joints)
      joints.push_back({{"name", printable(joint.name)},
                        {"kind", std::string(name_of(joint.kind))},
                        {"axis", point_json(joint.axis)},
                        {"anchor", point_json(joint.anchor)},
                        {"reference", joint.reference}});
    links.push_back({{"name", printable(link.name)},
                     {"parent", link.parent},
                     {"turn", numbers_json(link.rest.linear)},
                     {"origin", point_json(link.rest.translation)},
                     {"joints", std::move(joints)}});
  }
  return links;
}

/// Writes the core's kind, and its size in the file's form.
void add_core(const ShapeCore& core, const std::string& name, Json& json) {
  switch (core.kind) {
    case CoreKind::point:
      json["core"] = "point";
      break;
    case CoreKind::segment:
      json["core"] = "segment";
      json["size"] = Json::array({core.size.z()});
      break;
    case CoreKind::box:
      json["core"] = "box";
      json["size"] = point_json(core.size);
      break;
    case CoreKind::disks:
      json["core"] = "disks";  // radii below and above, half the height
      json["size"] = point_json(core.size);
      break;
    case CoreKind::ellipsoid:
      json["core"] = "ellipsoid";
      json["size"] = point_json(core.size);
      break;
    case CoreKind::hull: {
      json["core"] = "hull";
      Json points = Json::array();
      for (int i = 0; i < core.count; ++i) {
        // Skips the copies of the last point that pad hulls.
        if (i > 0 && core.x[i] == core.x[i - 1] && core.y[i] == core.y[i - 1] &&
            core.z[i] == core.z[i - 1])
          continue;
        points.push_back(Json::array({core.x[i], core.y[i], core.z[i]}));
      }
      json["points"] = std::move(points);
      break;
    }
    case CoreKind::other:
      throw BadInput(
          "proof: the body \"" + printable(name, 100) +
          "\" has a shape that proof files do not support; it is verified without a proof");
  }
}

/// Writes the hull of a mesh: a plane that separates the hull separates the mesh.
void add_hull(const ClearanceBody& body, Json& json) {
  json["core"] = "hull";
  Json points = Json::array();
  for (const Vec3<double>& point : hull_points_of(*body.mesh))
    points.push_back(point_json(Vec3<double>(point - body.own_middle())));
  json["points"] = std::move(points);
  json["radius"] = 0.0;
  json["turn"] = numbers_json(body.linear);
}

/// Writes the triangles of a mesh that encloses another body.
void add_triangles(const ClearanceBody& body, Json& json) {
  Json points = Json::array(), triangles = Json::array();
  for (const Vec3<double>& vertex : body.mesh->vertices())
    points.push_back(point_json(Vec3<double>(vertex - body.own_middle())));
  for (const Corners& corners : body.mesh->triangles())
    triangles.push_back(Json::array({corners[0], corners[1], corners[2]}));
  json["points"] = std::move(points);
  json["triangles"] = std::move(triangles);
}

Json bodies_json(const Provable& proven) {
  std::set<std::size_t> enclosing;
  for (const std::size_t pair : proven.enclosures) enclosing.insert(proven.pairs[pair].a);
  Json list = Json::array();
  for (const ClearanceBody& body : proven.bodies) {
    const bool is_enclosing = enclosing.contains(list.size());
    Json json = {{"name", printable(body.name)}, {"link", body.link_index}};
    if (body.plane) {
      json["plane"] = point_json(body.plane->normal);
      json["middle"] = point_json(body.plane->point.rounded());
    } else {
      if (body.mesh) {
        add_hull(body, json);
        if (is_enclosing) add_triangles(body, json);
      } else {
        const ShapeCore& core = body.shape.core();
        add_core(core, body.name, json);
        json["radius"] = core.radius;
        json["turn"] = numbers_json(body.linear * body.shape.turn());
      }
      json["middle"] = point_json(body.middle.at.rounded());
    }
    list.push_back(std::move(json));
  }
  return list;
}

Json rows_json(const std::vector<std::vector<std::vector<double>>>& rows) {
  Json list = Json::array();
  for (const auto& row : rows) {
    Json joints = Json::array();
    for (const std::vector<double>& numbers : row) joints.push_back(Json(numbers));
    list.push_back(std::move(joints));
  }
  return list;
}

/// Merges a plane with those of the next steps while they are equal. Parts of one step are not
/// merged, since a pair's deviation depends on their length.
Json planes_json(std::vector<SeparatingPlane> planes) {
  std::ranges::stable_sort(planes, [](const SeparatingPlane& a, const SeparatingPlane& b) {
    if (a.pair != b.pair) return a.pair < b.pair;
    return a.step != b.step ? a.step < b.step : a.first < b.first;
  });
  Json list = Json::array();
  for (std::size_t i = 0; i < planes.size();) {
    std::size_t last = i;
    const auto follows = [&](const SeparatingPlane& next, const SeparatingPlane& before) {
      return next.pair == before.pair && next.normal == before.normal &&
             next.step == before.step + 1 && next.first == 0 && before.last == 1;
    };
    while (last + 1 < planes.size() && follows(planes[last + 1], planes[last])) ++last;
    const SeparatingPlane &from = planes[i], &to = planes[last];
    list.push_back(Json::array({from.pair, from.step, from.first, to.step, to.last, from.normal.x(),
                                from.normal.y(), from.normal.z()}));
    i = last + 1;
  }
  return list;
}

/// No body is further from the world's origin, nor from its link's.
double furthest(const std::vector<ClearanceBody>& bodies, const JointPath& path) {
  double far = 0;
  std::vector<double> reaches(path.skeleton.links.size(), 0.0);
  for (const ClearanceBody& body : bodies) {
    if (body.plane)
      far = std::max(far, length_of(body.plane->point.high));
    else if (body.link_index < 0)
      far = std::max(far, body.reach());
    else
      reaches[static_cast<std::size_t>(body.link_index)] =
          std::max(reaches[static_cast<std::size_t>(body.link_index)], body.reach());
  }
  for (std::size_t step = 0; step < path.steps(); ++step) {
    const StepMotion motion(path, step);
    for (std::size_t link = 0; link < reaches.size(); ++link)
      if (reaches[link] > 0)
        far = std::max(far, motion.bound(static_cast<int>(link), -1, reaches[link]).reach);
  }
  return far;
}

/// Claims slightly less than was proven, since the checker rounds, too: it takes up to 1e-12 of the
/// distances from the origin of the world from each gap.
double claimed(double lower, const std::vector<ClearanceBody>& bodies, const JointPath& path) {
  constexpr double of_clearance = 1e-9, of_distances = 1e-11;
  const double claim = (1 - of_clearance) * lower - of_distances * furthest(bodies, path);
  if (!(claim > 0))
    throw BadInput("proof: the minimum clearance is too small for the rounding of minkray-check (" +
                   number_json(lower).dump() + " m); the verdict itself needs no proof");
  return claim;
}

}  // namespace

std::string proof_text(const Provable& proven, const JointPath& path, const ProofInputs& inputs) {
  const auto& [verdict, bodies, pairs, enclosures] = proven;
  if (verdict.status == MotionStatus::undecided)
    throw BadInput("proof: the motion is undecided: there is nothing to prove");
  Json json = {{"format", "minkray proof 1"},
               {"by", inputs.by},
               {"status", std::string(name_of(verdict.status))}};
  if (verdict.status == MotionStatus::free)
    json["lower"] = number_json(claimed(verdict.least.lower, bodies, path));
  Json files = Json::array();
  for (const std::filesystem::path& file : inputs.files)
    files.push_back({{"name", printable(file.string())},
                     {"sha256", sha256(read_regular_file(file, most_file_bytes))}});
  json["files"] = std::move(files);
  json["links"] = links_json(path.skeleton);
  json["bodies"] = bodies_json(proven);
  json["times"] = path.times;
  json["values"] = rows_json(path.values);
  json["rates"] = rows_json(path.rates);
  json["accelerations"] = rows_json(path.accelerations);
  Json list = Json::array();
  for (const RefereePair& pair : pairs) list.push_back(Json::array({pair.a, pair.b, pair.margin}));
  json["pairs"] = std::move(list);
  if (verdict.status == MotionStatus::free) {
    json["planes"] = planes_json(verdict.planes);
  } else {
    Json crossing = Json::array(), within = Json::array();
    for (const Stretch& stretch : verdict.stretches) {
      if (!stretch.collides) continue;
      const bool is_within = std::ranges::binary_search(enclosures, stretch.pair);
      (is_within ? within : crossing).push_back(Json::array({stretch.pair, stretch.time}));
    }
    json["collisions"] = std::move(crossing);
    json["enclosures"] = std::move(within);
  }
  std::string text = json.dump();
  text.pop_back();
  return text + ",\"sha256\":\"" + sha256(text) + "\"}\n";
}

}  // namespace minkray
