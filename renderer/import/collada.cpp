// SPDX-License-Identifier: MIT
#include "renderer/import/collada.h"

#include <numbers>
#include <stdexcept>
#include <unordered_map>

#include "renderer/import/xml.h"

namespace minkray {
namespace {

/// A node may show other nodes, and these others, so that few lines could show meshes without end.
constexpr std::size_t most_vertices = 20'000'000;
constexpr int deepest_node = 64;

class Collada {
 public:
  Collada(const XmlElement& root, XmlFiles& files) : root_(root), files_(files) { index(root); }

  MeshParts read() {
    Affine<double> up;
    if (const XmlElement* asset = root_.child("asset")) {
      if (const XmlElement* unit = asset->child("unit"))
        if (const auto meter = files_.number(*unit, "meter")) up.linear *= *meter;
      if (const XmlElement* axis = asset->child("up_axis")) up.linear = z_up(*axis) * up.linear;
    }
    const XmlElement* scene = nullptr;
    if (const XmlElement* chosen = root_.child("scene"))
      if (const XmlElement* instance = chosen->child("instance_visual_scene"))
        scene = target(*instance, "url");
    if (!scene)
      if (const XmlElement* library = root_.child("library_visual_scenes"))
        scene = library->child("visual_scene");
    if (scene) {
      for (const XmlElement& node : scene->children)
        if (node.name == "node") add_node(node, up, 0);
    } else if (const XmlElement* library = root_.child("library_geometries")) {
      for (const XmlElement& geometry : library->children) add_geometry(geometry, up);
    }
    return std::move(mesh_);
  }

 private:
  void index(const XmlElement& element) {
    if (const std::string* id = element.attribute("id")) by_id_.emplace(*id, &element);
    for (const XmlElement& child : element.children) index(child);
  }

  const XmlElement* target(const XmlElement& element, std::string_view key) const {
    const std::string* url = element.attribute(key);
    if (!url || !url->starts_with('#')) return nullptr;
    const auto found = by_id_.find(url->substr(1));
    return found == by_id_.end() ? nullptr : found->second;
  }

  static Mat3<double> z_up(const XmlElement& axis) {
    Mat3<double> turn = Mat3<double>::Identity();
    if (axis.text == "Y_UP") turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    if (axis.text == "X_UP") turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return turn;
  }

  /// The node's transforms, in the order in which they stand.
  Affine<double> transform_of(const XmlElement& node) {
    Affine<double> all;
    for (const XmlElement& step : node.children) {
      const auto numbers = [&](std::size_t count) {
        return files_.numbers_in(step, step.text, step.name, count, count);
      };
      Affine<double> one;
      if (step.name == "matrix") {
        if (const auto m = numbers(16)) {
          for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j)
              one.linear(i, j) = (*m)[static_cast<std::size_t>(4 * i + j)];
            one.translation[i] = (*m)[static_cast<std::size_t>(4 * i + 3)];
          }
        }
      } else if (step.name == "translate") {
        if (const auto v = numbers(3)) one.translation = {(*v)[0], (*v)[1], (*v)[2]};
      } else if (step.name == "scale") {
        if (const auto v = numbers(3))
          one.linear = Vec3<double>((*v)[0], (*v)[1], (*v)[2]).asDiagonal();
      } else if (step.name == "rotate") {
        if (const auto v = numbers(4)) {
          const Vec3<double> axis = unit<double>({(*v)[0], (*v)[1], (*v)[2]});
          const double half = (*v)[3] * std::numbers::pi / 360;
          const Vec3<double> s = axis * std::sin(half);
          if (!axis.isZero(0)) one.linear = rotation_matrix(s.x(), s.y(), s.z(), std::cos(half));
        }
      } else {
        continue;
      }
      all = all * one;
    }
    return all;
  }

  void add_node(const XmlElement& node, const Affine<double>& outer, int depth) {
    if (depth > deepest_node) throw std::runtime_error("nodes are nested too deeply, or for ever");
    const Affine<double> pose = outer * transform_of(node);
    for (const XmlElement& child : node.children) {
      if (child.name == "node") add_node(child, pose, depth + 1);
      if (child.name == "instance_node")
        if (const XmlElement* other = target(child, "url")) add_node(*other, pose, depth + 1);
      if (child.name == "instance_geometry")
        if (const XmlElement* geometry = target(child, "url")) add_geometry(*geometry, pose);
      if (child.name == "instance_controller")
        if (const XmlElement* controller = target(child, "url"))
          if (const XmlElement* skin = controller->child("skin"))
            if (const XmlElement* geometry = target(*skin, "source")) add_geometry(*geometry, pose);
    }
  }

  void add_geometry(const XmlElement& geometry, const Affine<double>& pose) {
    const XmlElement* mesh = geometry.child("mesh");
    const XmlElement* vertices = mesh ? mesh->child("vertices") : nullptr;
    if (!vertices) return;
    for (const XmlElement& input : vertices->children) {
      if (input.name != "input" || input.attribute_or("semantic") != "POSITION") continue;
      const XmlElement* source = target(input, "source");
      const XmlElement* array = source ? source->child("float_array") : nullptr;
      if (!array) continue;
      const auto numbers =
          files_.numbers_in(*array, array->text, "float_array", 0, 3 * most_vertices);
      if (!numbers) return;
      std::vector<std::uint32_t>& part = mesh_.parts.emplace_back();
      if (mesh_.vertices.size() + numbers->size() / 3 > most_vertices)
        throw std::runtime_error("shows more than " + std::to_string(most_vertices) + " vertices");
      for (std::size_t i = 0; i + 2 < numbers->size(); i += 3) {
        part.push_back(static_cast<std::uint32_t>(mesh_.vertices.size()));
        mesh_.vertices.push_back(
            pose(Vec3<double>((*numbers)[i], (*numbers)[i + 1], (*numbers)[i + 2])));
      }
      if (part.empty()) mesh_.parts.pop_back();
    }
  }

  const XmlElement& root_;
  XmlFiles& files_;
  std::unordered_map<std::string, const XmlElement*> by_id_;
  MeshParts mesh_;
};

}  // namespace

MeshParts read_collada(const std::filesystem::path& file, MeshSplit split) {
  Mistakes mistakes("");
  XmlFiles files(mistakes);
  MeshParts mesh;
  if (const auto root = files.read(file, most_collada_bytes)) {
    if (root->name != "COLLADA") throw std::runtime_error("is no COLLADA file");
    mesh = Collada(*root, files).read();
  }
  if (!mistakes.none()) {
    std::string first = mistakes.messages().front();
    throw std::runtime_error(first.starts_with(": ") ? first.substr(2) : first);
  }
  if (mesh.vertices.empty()) throw std::runtime_error("has no vertices");
  if (split == MeshSplit::none) mesh.parts.clear();
  return mesh;
}

}  // namespace minkray
