// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/gltf.h"

#include <algorithm>
#include <stdexcept>

#include "core/files/regular_file.h"
#include "renderer/image/colour.h"
#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/mesh/gltf_document.h"
#include "renderer/import/mesh/gltf_meshes.h"
#include "renderer/import/mesh/gltf_shapes.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

constexpr const char* physics = "KHR_physics_rigid_bodies";

class GltfReader {
 public:
  GltfReader(GltfDocument& document, const std::filesystem::path& file,
             const ImportOptions& options)
      : document_(document),
        meshes_(document, options.split,
                options.keeps_triangles() ? MeshDetail::attributes : MeshDetail::vertices),
        library_(file.parent_path(), options),
        splits_(options.split) {}

  Model read(const std::filesystem::path& file) {
    model_.format = "glTF";
    model_.name = file.stem().string();
    for (std::size_t i = 0; i < document_.count("nodes"); ++i)
      if (physics_of(i, "collider")) has_colliders_ = true;
    struct Open {
      std::size_t node;
      int parent;
      Affine<double> outer;
    };
    std::vector<Open> open;
    for (const std::size_t root : gltf_roots(document_)) open.push_back({root, -1, gltf_z_up()});
    std::ranges::reverse(open);
    while (!open.empty()) {
      const Open at = open.back();
      open.pop_back();
      const Affine<double> own = gltf_pose(document_, at.node);
      const auto link = static_cast<int>(model_.links.size());
      model_.links.push_back(
          {name_of_node(at.node), at.parent, at.parent < 0 ? at.outer * own : own});
      const Affine<double> in_world = at.outer * own;
      add_geoms(at.node, link, in_world);
      auto children = gltf_children(document_, at.node);
      for (auto child = children.rbegin(); child != children.rend(); ++child)
        open.push_back({*child, link, in_world});
    }
    for (const auto& [list, why] : {std::pair{"animations", "ignored, nodes keep their pose"},
                                    {"cameras", "not a shape"},
                                    {"skins", "ignored, meshes keep their shape"}})
      if (const std::size_t count = document_.count(list); count > 0)
        model_.pass_over(list, why, count);
    for (const std::string& name : document_.unread_extensions())
      model_.pass_over("extension " + printable(name, 60), "not supported");
    if (meshes_.left_out() > 0)
      model_.pass_over("primitives", "are points or lines", meshes_.left_out());
    for (const auto& [why, count] : meshes_.looks().colours_left_out())
      model_.pass_over("colours of vertices", why, count);
    if (model_.links.empty() && document_.mistakes().none())
      document_.mistakes().add(JsonPath() / "nodes", "must have visible nodes");
    library_.hand_over(model_);
    model_.hash += document_.hash_text();
    const std::vector<std::filesystem::path>& files = document_.files();
    model_.files.insert(model_.files.end(), files.begin(), files.end());
    return std::move(model_);
  }

 private:
  std::string name_of_node(std::size_t node) {
    const Json* name = document_.item("nodes", node).find("name");
    return name && name->is_string() && !name->text().empty() ? name->get<std::string>()
                                                              : "node " + std::to_string(node);
  }

  /// A key of a node's physics.
  const Json* physics_of(std::size_t node, std::string_view key) {
    const Json* at = &document_.item("nodes", node);
    for (const std::string_view next :
         {std::string_view("extensions"), std::string_view(physics), key})
      if (!at || !at->is_object() || !(at = at->find(next))) return nullptr;
    return at;
  }

  void add_geoms(std::size_t node, int link, const Affine<double>& in_world) {
    const Json& json = document_.item("nodes", node);
    const JsonPath path = JsonPath() / "nodes" / node;
    const auto mesh = document_.index(json, path, "mesh", "meshes");
    const Json* collider = physics_of(node, "collider");
    if (!mesh && !collider) return;
    const double volume = std::abs(in_world.linear.determinant());
    if (!(volume > 0) || !std::isfinite(volume) || !in_world.linear.inverse().allFinite())
      return model_.pass_over("nodes", "have a scale of zero: skipped");
    if (mesh) {
      ModelGeom geom;
      geom.link = link;
      geom.collides = !has_colliders_;
      // A skin's vertices keep their places, wherever its node is.
      Affine<double> pose;
      if (json.contains("skin")) pose = in_world.inverse() * gltf_z_up();
      for (const Affine<double>& instance : gltf_instances(document_, node)) {
        geom.pose = pose * instance;
        const double size = std::abs(instance.linear.determinant());
        if (!(size > 0) || !std::isfinite(size)) {
          model_.pass_over("instances", "have a scale of zero: skipped");
          continue;
        }
        if (!add_mesh_geoms(gltf_mesh_use(document_, *mesh, node), geom, path / "mesh")) break;
      }
    }
    if (collider) add_collider(*collider, path / "extensions" / physics / "collider", link);
    if (physics_of(node, "trigger")) model_.pass_over("triggers", "not bodies");
    if (physics_of(node, "joint")) model_.pass_over("joints", "ignored, nodes keep their pose");
  }

  const MeshLibrary::Answer& parts_of(const GltfMeshUse& use) {
    const auto known = parts_.find(use);
    if (known != parts_.end()) return known->second;
    const MeshParts& parts = meshes_.mesh(use);
    MeshLibrary::Answer& answer = parts_[use];
    if (parts.vertices.empty()) return answer;
    const Json* name = document_.item("meshes", use.mesh).find("name");
    answer = library_.made_of(
        parts, Vec3<double>::Ones(),
        name && name->is_string() ? name->get<std::string>() : "mesh " + std::to_string(use.mesh));
    answer.materials = materials();
    for (const std::string& note : notes_of(parts.attributes)) model_.pass_over("mesh", note);
    if (!answer.complaint.empty())
      document_.mistakes().add(JsonPath() / "meshes" / use.mesh, answer.complaint);
    return answer;
  }

  /// All materials that the primitives read so far have, with their pictures.
  const MeshLibrary::Materials& materials() {
    std::vector<MeshMaterial> all = meshes_.looks().materials();
    const std::size_t known = materials_ ? materials_->size() : 0;
    if (all.size() == known) return materials_;
    all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(known));
    std::vector<std::string> notes;
    const MeshLibrary::Materials more = library_.read_pictures(std::move(all), notes);
    for (const std::string& note : notes) model_.pass_over("material", note);
    auto joined = std::make_shared<std::vector<MeshMaterial>>();
    if (materials_) *joined = *materials_;
    joined->insert(joined->end(), more->begin(), more->end());
    return materials_ = std::move(joined);
  }

  /// Colliders that the nodes below show; as one hull if requested.
  const MeshLibrary::Answer& parts_of_node(std::size_t node, bool is_one) {
    const auto [at, is_new] = parts_of_nodes_.try_emplace({node, is_one});
    if (!is_new) return at->second;
    MeshParts all;
    meshes_.add_shown(std::span(&node, 1), {}, false, all);
    if (is_one) all.parts.clear();
    if (!all.vertices.empty())
      at->second = library_.made_of(all, Vec3<double>::Ones(), "collider of " + name_of_node(node));
    return at->second;
  }

  /// `path` is where the mesh is named. False if there are too many.
  bool add_mesh_geoms(const GltfMeshUse& use, const ModelGeom& geom, const JsonPath& path) {
    const MeshLibrary::Answer& answer = parts_of(use);
    const std::size_t before = model_.geoms.size();
    if (const auto complaint = add_parts(model_, answer, geom, Colouring::of_mesh)) {
      document_.mistakes().add(path, *complaint);
      return false;
    }
    const Json* primitives = document_.item("meshes", use.mesh).find("primitives");
    const std::vector<std::size_t>& of_part = meshes_.primitives_of_parts(use);
    for (std::size_t i = before; i < model_.geoms.size(); ++i) {
      const std::size_t primitive = splits_ == MeshSplit::groups ? of_part[i - before] : 0;
      if (primitives && primitive < primitives->size() && (*primitives)[primitive].is_object())
        model_.geoms[i].rgba =
            meshes_.looks()
                .colour_of((*primitives)[primitive],
                           JsonPath() / "meshes" / use.mesh / "primitives" / primitive)
                .value_or(Rgba{0.7, 0.7, 0.7, 1});
    }
    return true;
  }

  void add_collider(const Json& collider, const JsonPath& path, int link) {
    // Drafts of the extension had the keys of "geometry" in the collider itself.
    const Json* geometry = collider.is_object() ? collider.find("geometry") : nullptr;
    const JsonPath at = geometry ? path / "geometry" : path;
    if (!geometry) geometry = &collider;
    ModelGeom geom;
    geom.link = link;
    geom.is_seen = false;
    if (!geometry->is_object())
      return document_.mistakes().add(at, "must be an object (" + found(*geometry) + ")");
    if (const Json* number = geometry->find("shape")) {
      auto shape = gltf_shape(document_, *number, at / "shape");
      if (!shape) return;
      geom.kind = shape->kind;
      geom.shape = std::move(shape->shape);
      geom.pose = shape->pose;
      model_.geoms.push_back(std::move(geom));
    } else if (const auto mesh = document_.index(*geometry, at, "mesh", "meshes")) {
      add_mesh_geoms(gltf_mesh_use(document_, *mesh), geom, at / "mesh");
    } else if (const auto node = document_.index(*geometry, at, "node", "nodes")) {
      const Json* convex = geometry->find("convexHull");
      const MeshLibrary::Answer& answer =
          parts_of_node(*node, convex && convex->is_boolean() && convex->get<bool>());
      if (!answer.complaint.empty()) return document_.mistakes().add(at, answer.complaint);
      if (const auto complaint = add_parts(model_, answer, geom))
        document_.mistakes().add(at, *complaint);
    } else {
      document_.mistakes().add(at, "must name a \"shape\" or a \"node\"");
    }
  }

  GltfDocument& document_;
  GltfMeshes meshes_;
  MeshLibrary library_;
  MeshSplit splits_;
  Model model_;
  std::map<GltfMeshUse, MeshLibrary::Answer> parts_;
  std::map<std::pair<std::size_t, bool>, MeshLibrary::Answer> parts_of_nodes_;
  MeshLibrary::Materials materials_;
  bool has_colliders_ = false;
};

}  // namespace

Model read_gltf(std::string bytes, const std::filesystem::path& file, const ImportOptions& options,
                Mistakes& mistakes) {
  GltfDocument document(std::move(bytes), file, mistakes);
  if (!document.root() || !mistakes.none()) return {};
  return GltfReader(document, file, options).read(file);
}

MeshContent read_gltf_content(const std::filesystem::path& file, MeshSplit split,
                              MeshDetail detail) {
  Mistakes mistakes("");
  GltfDocument document(read_regular_file(file, most_gltf_bytes), file, mistakes);
  MeshParts all;
  MeshLooks looks;
  std::vector<MeshMaterial> materials;
  if (document.root() && mistakes.none()) {
    GltfMeshes meshes(document, split, detail);
    const std::vector<std::size_t> roots = gltf_roots(document);
    if (mistakes.none()) meshes.add_shown(roots, gltf_z_up(), true, all, &looks);
    if (detail == MeshDetail::attributes) materials = meshes.looks().materials();
    for (const auto& [why, count] : meshes.looks().colours_left_out())
      looks.notes.push_back("colours of vertices: " + why);
  }
  if (!mistakes.none()) {
    const std::string first = mistakes.messages().front();
    throw std::runtime_error(first.starts_with(": ") ? first.substr(2) : first);
  }
  if (all.vertices.empty()) throw std::runtime_error("has no vertices");
  settle(all.attributes);
  if (detail == MeshDetail::vertices) all.triangles.clear();
  looks.files = document.files();
  for (const std::string& name : document.unread_extensions())
    looks.notes.push_back("extension " + printable(name, 60) + " not supported");
  return {std::move(all), std::move(looks), std::move(materials)};
}

}  // namespace minkray
