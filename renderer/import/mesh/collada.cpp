// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/collada.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <unordered_map>

#include "core/files/text.h"
#include "renderer/import/mesh/collada_faces.h"
#include "renderer/import/mesh/collada_looks.h"

namespace minkray {
namespace {

/// A node may show other nodes, and these others, so that few lines could show meshes without end.
constexpr std::size_t most_vertices = most_collada_vertices;
constexpr int deepest_node = 64;
constexpr std::size_t most_shown = 1'000'000;  ///< nodes and meshes
constexpr std::size_t most_triangles_of_vertex = 8;

using FaceCorners = std::array<std::uint32_t, 3>;

std::size_t count_words(std::string_view text) {
  std::size_t count = 0;
  while (!next_word(text).empty()) ++count;
  return count;
}

class Collada {
 public:
  Collada(const XmlElement& root, XmlFiles& files, MeshSplit split, MeshDetail detail,
          std::filesystem::path folder)
      : root_(root), files_(files), split_(split), detail_(detail), folder_(std::move(folder)) {
    index(root);
    most_ = std::min(most_vertices, most_shown_vertices(numbers_));
  }

  MeshContent read() {
    Affine<double> scale;
    if (const XmlElement* asset = root_.child("asset"))
      if (const XmlElement* unit = asset->child("unit"))
        if (const auto meter = files_.number(*unit, "meter")) scale.linear *= *meter;
    const XmlElement* scene = nullptr;
    if (const XmlElement* chosen = root_.child("scene"))
      if (const XmlElement* instance = chosen->child("instance_visual_scene"))
        scene = target(*instance, "url");
    if (!scene)
      if (const XmlElement* library = root_.child("library_visual_scenes"))
        scene = library->child("visual_scene");
    if (scene) {
      for (const XmlElement& node : scene->children)
        if (node.name == "node") add_node(node, scale, 0);
    } else if (const XmlElement* library = root_.child("library_geometries")) {
      for (const XmlElement& geometry : library->children)
        add_geometry({.geometry = &geometry}, geometry_of(geometry), scale);
    }
    settle(mesh_.attributes);
    return {std::move(mesh_), std::move(looks_), std::move(materials_)};
  }

 private:
  /// Something that a node shows, in document order.
  struct Shown {
    const XmlElement* node = nullptr;
    const XmlElement* geometry = nullptr;        ///< if it is no node
    const XmlElement* instance = nullptr;        ///< element with the geometry and its materials
    std::string of_node = {};                    ///< name of the node
    std::optional<Affine<double>> in_skin = {};  ///< pose of a mesh in a skin
  };
  struct Node {
    Affine<double> pose;
    std::vector<Shown> shows;
  };

  struct Geometry {
    std::vector<ColladaVectors> vertices;
    ColladaFaces faces;  ///< if triangles are wanted
  };

  void index(const XmlElement& element) {
    if (element.name == "float_array") numbers_ += count_words(element.text);
    if (const std::string* id = element.attribute("id")) by_id_.emplace(*id, &element);
    for (const XmlElement& child : element.children) index(child);
  }

  const XmlElement* target(const XmlElement& element, std::string_view key) const {
    const std::string* url = element.attribute(key);
    if (!url || !url->starts_with('#')) return nullptr;
    const auto found = by_id_.find(url->substr(1));
    return found == by_id_.end() ? nullptr : found->second;
  }

  Affine<double> matrix_of(const XmlElement& element) {
    Affine<double> map;
    if (const auto m = files_.numbers_in(element, element.text, element.name, 16, 16))
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) map.linear(i, j) = (*m)[static_cast<std::size_t>(4 * i + j)];
        map.translation[i] = (*m)[static_cast<std::size_t>(4 * i + 3)];
      }
    return map;
  }

  /// The node's transforms, in document order.
  Affine<double> transform_of(const XmlElement& node) {
    Affine<double> all;
    for (const XmlElement& step : node.children) {
      const auto numbers = [&](std::size_t count) {
        return files_.numbers_in(step, step.text, step.name, count, count);
      };
      Affine<double> one;
      if (step.name == "matrix") {
        one = matrix_of(step);
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

  /// Each is read once, however often it is shown.
  const Node& node_of(const XmlElement& element) {
    const auto [at, is_new] = nodes_.try_emplace(&element);
    Node& node = at->second;
    if (!is_new) return node;
    node.pose = transform_of(element);
    for (const XmlElement& child : element.children) {
      if (child.name == "node") node.shows.push_back({.node = &child});
      if (child.name == "instance_node")
        if (const XmlElement* other = target(child, "url")) node.shows.push_back({.node = other});
      if (child.name == "instance_geometry")
        if (const XmlElement* geometry = target(child, "url"))
          node.shows.push_back(
              {.geometry = geometry, .instance = &child, .of_node = collada_name(element)});
      if (child.name == "instance_controller")
        if (const XmlElement* controller = target(child, "url"))
          if (const XmlElement* skin = controller->child("skin"))
            if (const XmlElement* geometry = target(*skin, "source")) {
              Shown shown{
                  .geometry = geometry, .instance = &child, .of_node = collada_name(element)};
              if (const XmlElement* bind = skin->child("bind_shape_matrix"))
                shown.in_skin = matrix_of(*bind);
              node.shows.push_back(shown);
            }
    }
    return node;
  }

  const Geometry& geometry_of(const XmlElement& element) {
    const auto [at, is_new] = geometries_.try_emplace(&element);
    Geometry& geometry = at->second;
    const XmlElement* mesh = is_new ? element.child("mesh") : nullptr;
    const XmlElement* vertices = mesh ? mesh->child("vertices") : nullptr;
    if (!vertices) return geometry;
    for (const XmlElement& input : vertices->children) {
      if (input.name != "input" || input.attribute_or("semantic") != "POSITION") continue;
      if (const auto vectors = vectors_of(input, 3)) geometry.vertices.push_back(*vectors);
    }
    if ((split_ == MeshSplit::components || with_triangles()) && !geometry.vertices.empty())
      geometry.faces = read_collada_faces(
          *mesh, files_, detail_ == MeshDetail::attributes,
          [this](const XmlElement& input, std::size_t width) { return vectors_of(input, width); });
    return geometry;
  }

  bool with_triangles() const { return detail_ != MeshDetail::vertices; }

  /// The vectors of `width` numbers that an input names.
  std::optional<ColladaVectors> vectors_of(const XmlElement& input, std::size_t width) {
    const XmlElement* source = target(input, "source");
    const XmlElement* array = source ? source->child("float_array") : nullptr;
    if (!array) return std::nullopt;
    const std::vector<double>& numbers = numbers_of(*array);
    const auto [begin, stride] = layout_of(*source, static_cast<double>(width));
    if (numbers.size() < begin + width) return std::nullopt;
    return ColladaVectors{&numbers, begin, stride, (numbers.size() - begin - width) / stride + 1};
  }

  /// Numbers of an array; empty, with an error reported, if any is invalid.
  const std::vector<double>& numbers_of(const XmlElement& array) {
    const auto [at, is_new] = arrays_.try_emplace(&array);
    if (is_new)
      at->second = files_.numbers_in(array, array.text, "float_array", 0, 3 * most_vertices)
                       .value_or(std::vector<double>());
    return at->second;
  }

  void count_shown() {
    if (++shown_ > most_shown)
      throw std::runtime_error("must have at most " + std::to_string(most_shown) +
                               " nodes and meshes, with repeated instances");
  }

  void add_node(const XmlElement& element, const Affine<double>& outer, int depth) {
    if (depth > deepest_node)
      throw std::runtime_error("nodes are nested too deeply, or in a cycle");
    count_shown();
    const Node& node = node_of(element);
    const Affine<double> pose = outer * node.pose;
    for (const Shown& shown : node.shows) {
      if (shown.node)
        add_node(*shown.node, pose, depth + 1);
      else
        add_geometry(shown, geometry_of(*shown.geometry),
                     shown.in_skin ? pose * *shown.in_skin : pose);
    }
  }

  void add_geometry(const Shown& shown, const Geometry& geometry, const Affine<double>& pose) {
    count_shown();
    if (!geometry.vertices.empty() && looks_.parts.size() < most_part_looks) {
      PartLook look;
      // Wrong colours cost no mesh.
      files_.complaints_of([&] {
        look = collada_look(
            {shown.of_node, collada_name(*shown.geometry)}, *shown.geometry, shown.instance,
            [this](const XmlElement& from, std::string_view key) { return target(from, key); },
            files_);
      });
      for (std::size_t i = 0; i < geometry.vertices.size(); ++i) looks_.parts.push_back(look);
    }
    for (const auto& [numbers, begin, stride, count] : geometry.vertices) {
      const std::size_t first = mesh_.vertices.size();
      if (first + count > most_)
        throw std::runtime_error("must have at most " + std::to_string(most_) + " vertices, of " +
                                 std::to_string(numbers_) + " numbers in the file (got " +
                                 std::to_string(first + count) + ")");
      for (std::size_t i = 0; i < count; ++i) {
        const double* at = numbers->data() + begin + i * stride;
        mesh_.vertices.push_back(pose(Vec3<double>(at[0], at[1], at[2])));
      }
      add_parts(geometry, first);
      if (with_triangles()) add_triangles(shown, geometry, first, pose.linear);
    }
  }

  /// Offset of the first vector, and the count of numbers to the next one.
  std::pair<std::size_t, std::size_t> layout_of(const XmlElement& source, double width) {
    const XmlElement* common = source.child("technique_common");
    const XmlElement* accessor = common ? common->child("accessor") : nullptr;
    const auto number = [&](const char* key, double otherwise) {
      const auto value = accessor ? files_.number(*accessor, key) : std::nullopt;
      return std::clamp(value.value_or(otherwise), otherwise, 1e6);
    };
    return {static_cast<std::size_t>(number("offset", 0)),
            static_cast<std::size_t>(number("stride", width))};
  }

  void add_parts(const Geometry& geometry, std::size_t first) {
    const std::size_t count = mesh_.vertices.size() - first;
    if (split_ == MeshSplit::groups) {
      std::vector<std::uint32_t>& part = mesh_.parts.emplace_back(count);
      std::iota(part.begin(), part.end(), static_cast<std::uint32_t>(first));
    } else if (split_ == MeshSplit::components) {
      count_triangles(geometry, count);
      const auto own = std::span(mesh_.vertices).subspan(first);
      for (std::vector<std::uint32_t>& part : components_of(own, geometry.faces.triangles)) {
        for (std::uint32_t& i : part) i += static_cast<std::uint32_t>(first);
        mesh_.parts.push_back(std::move(part));
      }
    }
  }

  void count_triangles(const Geometry& geometry, std::size_t vertices) {
    if (geometry.faces.corners_end > vertices)
      throw std::runtime_error("a <p> refers to a missing vertex");
    triangles_ += geometry.faces.triangles.size();
    if (triangles_ > most_triangles_of_vertex * most_)
      throw std::runtime_error("must have at most " +
                               std::to_string(most_triangles_of_vertex * most_) +
                               " triangles (got " + std::to_string(triangles_) + ")");
  }

  void add_triangles(const Shown& shown, const Geometry& geometry, std::size_t first,
                     const Mat3<double>& linear) {
    count_triangles(geometry, mesh_.vertices.size() - first);
    const bool is_mirrored = linear.determinant() < 0;
    if (geometry.faces.attributes.any()) {
      MeshAttributes attributes = geometry.faces.attributes;
      map_normals(attributes, inverse_of(linear).transpose());
      if (is_mirrored) swap_corners(attributes);
      number_materials(attributes, geometry.faces.symbols, shown.instance);
      append(mesh_.attributes, mesh_.triangles.size(), attributes, geometry.faces.triangles.size(),
             0);
    }
    for (FaceCorners corners : geometry.faces.triangles) {
      for (std::uint32_t& i : corners) i += static_cast<std::uint32_t>(first);
      if (is_mirrored) std::swap(corners[1], corners[2]);
      mesh_.triangles.push_back(corners);
    }
  }

  /// Puts numbers of the file's materials in the place of the symbols'.
  void number_materials(MeshAttributes& attributes, const std::vector<std::string>& symbols,
                        const XmlElement* instance) {
    std::vector<std::uint32_t> numbers;
    for (const std::string& symbol : symbols)
      numbers.push_back(instance ? number_of(*instance, symbol) : MeshAttributes::none);
    for (std::uint32_t& material : attributes.material_of)
      material = material < numbers.size() ? numbers[material] : MeshAttributes::none;
  }

  std::uint32_t number_of(const XmlElement& instance, const std::string& symbol) {
    const ColladaTarget follow = [this](const XmlElement& from, std::string_view key) {
      return target(from, key);
    };
    const XmlElement* effect = collada_effect(instance, symbol, follow);
    if (!effect) return MeshAttributes::none;
    const auto [at, is_new] = material_of_effect_.try_emplace(effect, MeshAttributes::none);
    if (!is_new) return at->second;
    std::optional<MeshMaterial> material;
    const auto with_id = [this](const std::string& id) {
      const auto found = by_id_.find(id);
      return found == by_id_.end() ? nullptr : found->second;
    };
    // Wrong colours cost no mesh.
    files_.complaints_of(
        [&] { material = collada_material(*effect, with_id, follow, files_, folder_); });
    if (!material) return MeshAttributes::none;
    at->second = static_cast<std::uint32_t>(materials_.size());
    materials_.push_back(std::move(*material));
    return at->second;
  }

  const XmlElement& root_;
  XmlFiles& files_;
  MeshSplit split_;
  MeshDetail detail_;
  std::filesystem::path folder_;  ///< that pictures' names are relative to
  std::unordered_map<std::string, const XmlElement*> by_id_;
  std::unordered_map<const XmlElement*, Node> nodes_;
  std::unordered_map<const XmlElement*, Geometry> geometries_;
  std::unordered_map<const XmlElement*, std::vector<double>> arrays_;
  std::size_t numbers_ = 0;  ///< in all arrays of the file
  std::size_t most_ = 0;     ///< vertices that it may show
  std::size_t shown_ = 0, triangles_ = 0;
  MeshParts mesh_;
  MeshLooks looks_;
  std::vector<MeshMaterial> materials_;
  std::unordered_map<const XmlElement*, std::uint32_t> material_of_effect_;
};

}  // namespace

MeshContent read_collada(const std::filesystem::path& file, MeshSplit split, MeshDetail detail) {
  Mistakes mistakes("");
  XmlFiles files(mistakes);
  MeshContent content;
  if (const auto root = files.read(file, most_collada_bytes)) {
    if (root->name != "COLLADA") throw std::runtime_error("not a COLLADA file");
    content = Collada(*root, files, split, detail, file.parent_path()).read();
  }
  if (!mistakes.none()) {
    std::string first = mistakes.messages().front();
    throw std::runtime_error(first.starts_with(": ") ? first.substr(2) : first);
  }
  if (content.mesh.vertices.empty()) throw std::runtime_error("has no vertices");
  return content;
}

}  // namespace minkray
