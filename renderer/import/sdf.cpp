// SPDX-License-Identifier: MIT
#include "renderer/import/sdf.h"

#include <algorithm>
#include <map>
#include <memory>

#include "renderer/import/geometry_common.h"
#include "renderer/import/mesh_library.h"
#include "renderer/import/orientation.h"

namespace minkray {
namespace {

constexpr int deepest_model = 32;

/// A <model>'s names, each with its pose in the model's frame. Scoped names, "a::b", lead into
/// nested models.
struct Scope {
  /// A frame whose pose is given in another one.
  struct Frame {
    Affine<double> pose;
    std::string relative_to;
    const XmlElement* element;
    bool is_known = false;
    bool is_open = false;  ///< it is being looked for: to find it again is a circle
    Affine<double> in_model = {};
  };
  std::map<std::string, Frame> frames;
};

struct Joint {
  const XmlElement* element;
  std::string parent, child, name;
  Scope* scope;
  Affine<double> model_in_world;
  std::string prefix;
};

class SdfReader {
 public:
  SdfReader(XmlFiles& files, const ImportOptions& options) : files_(files), options_(options) {}

  Model read(const XmlElement& root) {
    model_.format = "SDF";
    read_world(root, 0);
    for (const XmlElement& world : root.children)
      if (world.name == "world") {
        model_.name = world.attribute_or("name");
        read_world(world, 0);
      }
    if (model_.links.empty() && !has_content_)
      files_.wrong(root, "must hold a <world>, a <model> or a <link>");
    connect();
    collect_meshes();
    return std::move(model_);
  }

 private:
  void read_world(const XmlElement& world, int depth) {
    for (const XmlElement& child : world.children) {
      if (child.name == "model" || child.name == "actor") {
        if (model_.name.empty()) model_.name = child.attribute_or("name");
        read_model(child, {}, "", depth, "");
      } else if (child.name == "include") {
        read_include(child, {}, "", depth);
      } else if (child.name == "world") {
        has_content_ = true;
      } else if (world.name == "world" && child.name != "physics" && child.name != "gravity") {
        model_.pass_over("<" + printable(child.name, 40) + ">", "is no geometry");
        has_content_ = true;
      }
    }
  }

  Affine<double> pose_in(const XmlElement& element) {
    const XmlElement* pose = element.child("pose");
    if (!pose) return {};
    const std::string format = pose->attribute_or("rotation_format", "euler_rpy");
    const std::size_t count = format == "quat_xyzw" ? 7 : 6;
    if (pose->text.find_first_not_of(" \t\r\n") == std::string::npos) return {};
    const auto v = files_.numbers_in(*pose, pose->text, "pose", count, count);
    if (!v) return {};
    Affine<double> result;
    result.translation = {(*v)[0], (*v)[1], (*v)[2]};
    if (count == 7) {
      result.linear = rotation_matrix_of_any((*v)[3], (*v)[4], (*v)[5], (*v)[6]);
    } else {
      const bool is_degrees =
          pose->attribute_or("degrees") == "true" || pose->attribute_or("degrees") == "1";
      const double unit_of_angle = is_degrees ? 3.14159265358979323846 / 180 : 1;
      result.linear = rotation_of_rpy(unit_of_angle * Vec3<double>((*v)[3], (*v)[4], (*v)[5]));
    }
    return result;
  }

  static std::string relative_to(const XmlElement& element) {
    const XmlElement* pose = element.child("pose");
    if (!pose) return "";
    const std::string* named = pose->attribute("relative_to");
    return named ? *named : pose->attribute_or("frame");
  }

  /// The pose of a name in its model's frame.
  Affine<double> resolve(Scope& scope, const std::string& name, const XmlElement& asks) {
    if (name.empty() || name == "__model__" || name == "world") return {};
    const auto found = scope.frames.find(name);
    if (found == scope.frames.end()) {
      files_.wrong(asks, "there is no frame \"" + printable(name, 60) + "\"");
      return {};
    }
    Scope::Frame& frame = found->second;
    if (frame.is_known) return frame.in_model;
    if (frame.is_open) {
      files_.wrong(asks, "frames must not be relative to each other in a circle");
      return {};
    }
    // Chains of frames may be long: each is made known from its end, without recursion.
    std::vector<Scope::Frame*> chain;
    Scope::Frame* at = &frame;
    const XmlElement* asker = &asks;
    Affine<double> outer;
    for (;;) {
      at->is_open = true;
      chain.push_back(at);
      const std::string& next = at->relative_to;
      asker = at->element;
      if (next.empty() || next == "__model__" || next == "world") break;
      const auto there = scope.frames.find(next);
      if (there == scope.frames.end() || there->second.is_open) {
        files_.wrong(*asker, there == scope.frames.end()
                                 ? "relative_to: there is no frame \"" + printable(next, 60) + "\""
                                 : "frames must not be relative to each other in a circle");
        break;
      }
      if (there->second.is_known) {
        outer = there->second.in_model;
        break;
      }
      at = &there->second;
    }
    for (auto one = chain.rbegin(); one != chain.rend(); ++one) {
      outer = outer * (*one)->pose;
      (*one)->in_model = outer;
      (*one)->is_known = true;
      (*one)->is_open = false;
    }
    return frame.in_model;
  }

  void read_model(const XmlElement& model, const Affine<double>& outer, const std::string& prefix,
                  int depth, const std::string& name_given,
                  const std::optional<Affine<double>>& pose_given = std::nullopt) {
    has_content_ = true;
    if (depth > deepest_model)
      return files_.wrong(model, "models are nested too deeply, or for ever");
    scopes_.push_back(std::make_unique<Scope>());
    Scope& scope = *scopes_.back();
    const Affine<double> pose = outer * pose_given.value_or(pose_in(model));
    const std::string name = name_given.empty() ? model.attribute_or("name") : name_given;
    const std::string inner = prefix + (name.empty() ? "" : name + "::");

    // Names first, for poses may be relative to what stands below.
    for (const XmlElement& child : model.children) {
      if (child.name != "link" && child.name != "frame" && child.name != "joint" &&
          child.name != "model")
        continue;
      Scope::Frame frame{pose_in(child), relative_to(child), &child};
      if (child.name == "joint" && frame.relative_to.empty())
        frame.relative_to = text_of(child, "child");
      if (child.name == "frame" && frame.relative_to.empty())
        frame.relative_to = child.attribute_or("attached_to");
      const std::string own = child.attribute_or("name");
      if (own.empty()) files_.wrong(child, "name: must be there");
      if (!scope.frames.emplace(own, frame).second && child.name != "joint")
        files_.wrong(child, "name: must not be given twice");
    }
    for (const XmlElement& child : model.children) {
      const std::string own = child.attribute_or("name");
      if (child.name == "link") {
        add_link(child, pose * resolve(scope, own, child), inner + own);
      } else if (child.name == "joint") {
        joints_.push_back({&child, text_of(child, "parent"), text_of(child, "child"), inner + own,
                           &scope, pose, inner});
      } else if (child.name == "model") {
        const Affine<double> at = resolve(scope, own, child);
        read_model(child, pose, inner, depth + 1, own, at);
      } else if (child.name == "include") {
        read_include(child, pose, inner, depth + 1);
      } else if (child.name == "plugin" || child.name == "gripper") {
        model_.pass_over("<" + child.name + ">", "is no geometry");
      }
    }
  }

  static std::string text_of(const XmlElement& element, std::string_view key) {
    const XmlElement* child = element.child(key);
    if (!child) return "";
    std::string text = child->text;
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == text.npos) return "";
    return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
  }

  /// Another file's model, in a folder with a model.config or a model.sdf.
  void read_include(const XmlElement& include, const Affine<double>& outer,
                    const std::string& prefix, int depth) {
    has_content_ = true;
    const std::string uri = text_of(include, "uri");
    if (uri.empty()) return files_.wrong(include, "uri: must be there");
    if (depth > deepest_model) return files_.wrong(include, "files include each other for ever");
    if (++includes_ > 1000) return files_.wrong(include, "includes more than 1000 files");
    const std::filesystem::path folder = files_.files()[include.file].parent_path();
    std::vector<std::filesystem::path> places;
    std::optional<std::filesystem::path> file;
    for (const char* inside : {"", "/model.sdf"}) {
      MeshLibrary library(folder, options_);
      if (!file) file = library.find(uri + inside, places);
    }
    if (!file) {
      if (uri == "model://sun") return model_.pass_over("<include>", "model://sun is a light");
      if (uri == "model://ground_plane") return add_ground_plane(include, outer);
      std::string text;
      for (const auto& place : places) text += (text.empty() ? "" : ", ") + place.string();
      return files_.wrong(include, "the model \"" + printable(uri, 100) +
                                       "\" is not there (looked for " + printable(text, 400) +
                                       "); --model-dir says where models are");
    }
    std::optional<XmlElement> root = files_.read(*file);
    if (!root) return;
    included_.push_back(std::make_unique<XmlElement>(std::move(*root)));
    for (const XmlElement& model : included_.back()->children) {
      if (model.name != "model") continue;
      std::optional<Affine<double>> pose;
      if (include.child("pose")) pose = pose_in(include);
      read_model(model, outer, prefix, depth + 1, text_of(include, "name"), pose);
      return;
    }
    files_.wrong(include, "the file " + printable(file->string(), 100) + " has no <model>");
  }

  /// Gazebo has it wherever it is installed.
  void add_ground_plane(const XmlElement& include, const Affine<double>& outer) {
    ModelGeom geom;
    geom.kind = "plane";
    geom.name = "ground_plane";
    geom.pose = outer * pose_in(include);
    model_.geoms.push_back(geom);
  }

  void add_link(const XmlElement& link, const Affine<double>& in_world, const std::string& name) {
    const int index = static_cast<int>(model_.links.size());
    if (!link_index_.emplace(name, index).second)
      files_.wrong(link, "name: must not be the name of two links");
    model_.links.push_back({name, -1, in_world});
    elements_.push_back(&link);
    for (const XmlElement& child : link.children) {
      if (child.name == "visual" || child.name == "collision")
        add_geom(child, index);
      else if (child.name == "light" || child.name == "sensor" || child.name == "projector" ||
               child.name == "particle_emitter")
        model_.pass_over("<" + child.name + ">", "is no geometry");
    }
  }

  void add_geom(const XmlElement& element, int link) {
    ModelGeom geom;
    geom.link = link;
    geom.name = element.attribute_or("name");
    if (!geom.name.empty())
      geom.name = model_.links[static_cast<std::size_t>(link)].name + "::" + geom.name;
    geom.is_seen = element.name == "visual";
    geom.collides = !geom.is_seen;
    geom.pose = pose_in(element);
    if (const XmlElement* material = element.child("material"))
      if (const XmlElement* diffuse = material->child("diffuse"))
        if (const auto v = files_.numbers_in(*diffuse, diffuse->text, "diffuse", 3, 4))
          geom.rgba = {(*v)[0], (*v)[1], (*v)[2], v->size() > 3 ? (*v)[3] : 1};
    const XmlElement* geometry = element.child("geometry");
    if (!geometry) return files_.wrong(element, "geometry: must be there");
    for (const XmlElement& shape : geometry->children) add_shape(shape, geom, link);
  }

  /// The sizes are elements of their own.
  void add_shape(const XmlElement& shape, ModelGeom geom, int link) {
    geom.kind = shape.name;
    bool is_good = true;
    const auto numbers = [&](const char* key, std::size_t count) {
      const XmlElement* child = shape.child(key);
      std::optional<std::vector<double>> v;
      if (!child)
        files_.wrong(shape, std::string(key) + ": must be there");
      else
        v = files_.numbers_in(*child, child->text, key, count, count);
      if (v && std::ranges::any_of(*v, [](double x) { return !(x > 0); })) {
        files_.wrong(*child, "must be > 0 (got \"" + printable(child->text, 60) + "\")");
        v.reset();
      }
      is_good &= v.has_value();
      return v.value_or(std::vector<double>(count, 1));
    };
    const auto one = [&](const char* key) { return numbers(key, 1)[0]; };
    if (shape.name == "box") {
      const auto s = numbers("size", 3);
      geom.shape = box_of({s[0] / 2, s[1] / 2, s[2] / 2});
    } else if (shape.name == "sphere") {
      geom.shape = sphere_of(one("radius"));
    } else if (shape.name == "cylinder") {
      const double radius = one("radius");
      geom.shape = cylinder_of(radius, one("length") / 2);
    } else if (shape.name == "capsule") {
      const double radius = one("radius");
      geom.shape = capsule_of(radius, one("length") / 2);
    } else if (shape.name == "ellipsoid") {
      const auto r = numbers("radii", 3);
      geom.shape = ellipsoid_of({r[0], r[1], r[2]});
    } else if (shape.name == "plane") {
      Vec3<double> normal(0, 0, 1);
      if (const XmlElement* child = shape.child("normal"))
        if (const auto v = files_.numbers_in(*child, child->text, "normal", 3, 3))
          normal = {(*v)[0], (*v)[1], (*v)[2]};
      if (unit(normal).isZero(0)) return files_.wrong(shape, "normal: must not be zero");
      geom.pose.linear = geom.pose.linear * rotation_of_z_to(normal);
    } else if (shape.name == "mesh") {
      const std::string uri = text_of(shape, "uri");
      if (uri.empty()) return files_.wrong(shape, "uri: must be there");
      Vec3<double> scale = Vec3<double>::Ones();
      if (const XmlElement* child = shape.child("scale"))
        if (const auto v = files_.numbers_in(*child, child->text, "scale", 3, 3))
          scale = {(*v)[0], (*v)[1], (*v)[2]};
      return add_mesh(model_, files_, shape, library_of(shape).hulls_of(uri, scale),
                      std::move(geom), options_);
    } else if (shape.name == "empty") {
      return;
    } else if (shape.name == "heightmap" || shape.name == "image" || shape.name == "polyline") {
      return model_.pass_over("<" + shape.name + ">", "is no convex shape");
    } else {
      return files_.wrong(shape, "is no geometry of SDF");
    }
    (void)link;
    if (is_good) model_.geoms.push_back(std::move(geom));
  }

  /// Each file looks for meshes beside itself. All of them share one list of meshes' facts.
  MeshLibrary& library_of(const XmlElement& element) {
    auto& library = libraries_[element.file];
    if (!library)
      library = std::make_unique<MeshLibrary>(files_.files()[element.file].parent_path(), options_);
    return *library;
  }

  /// Makes the links trees: each behind its parent, its pose relative to it.
  void connect() {
    const std::size_t count = model_.links.size();
    std::vector<int> joint_of(count, -1), parent_of(count, -1);
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const Joint& joint = joints_[j];
      const auto index_of = [&](const std::string& name) {
        const auto found = link_index_.find(joint.prefix + name);
        return found == link_index_.end() ? -1 : found->second;
      };
      const int child = index_of(joint.child), parent = index_of(joint.parent);
      if (child < 0 || (parent < 0 && joint.parent != "world")) {
        files_.wrong(*joint.element, "the link \"" +
                                         printable(child < 0 ? joint.child : joint.parent, 60) +
                                         "\" is not there");
        continue;
      }
      const auto c = static_cast<std::size_t>(child);
      if (joint_of[c] >= 0) {
        // A loop: the links stand where they are, and the first joint moves the child.
        model_.pass_over("<joint>", "closes a loop");
        continue;
      }
      joint_of[c] = static_cast<int>(j);
      parent_of[c] = parent;
    }
    std::vector<std::vector<int>> children(count);
    std::vector<int> order, open;
    for (std::size_t i = count; i-- > 0;) {
      if (parent_of[i] >= 0)
        children[static_cast<std::size_t>(parent_of[i])].push_back(static_cast<int>(i));
      else
        open.push_back(static_cast<int>(i));
    }
    while (!open.empty()) {
      const int link = open.back();
      open.pop_back();
      order.push_back(link);
      for (const int child : children[static_cast<std::size_t>(link)]) open.push_back(child);
    }
    std::vector<int> place(count, -1);
    for (std::size_t i = 0; i < order.size(); ++i)
      place[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    std::vector<ModelLink> links;
    for (const int old : order) {
      const auto i = static_cast<std::size_t>(old);
      ModelLink link = model_.links[i];
      const Affine<double> in_world = link.rest;
      if (parent_of[i] >= 0) {
        const auto p = static_cast<std::size_t>(parent_of[i]);
        link.parent = place[p];
        link.rest = model_.links[p].rest.inverse() * in_world;
      }
      if (joint_of[i] >= 0)
        add_joint(joints_[static_cast<std::size_t>(joint_of[i])], in_world, link);
      links.push_back(std::move(link));
    }
    if (order.size() < count) {
      for (std::size_t i = 0; i < count; ++i)
        if (place[i] < 0) {
          files_.wrong(*elements_[i], "joints must not run in a circle");
          break;
        }
      return;
    }
    model_.links = std::move(links);
    for (ModelGeom& geom : model_.geoms)
      if (geom.link >= 0) geom.link = place[static_cast<std::size_t>(geom.link)];
    std::ranges::stable_sort(model_.geoms, {}, &ModelGeom::link);
  }

  void add_joint(const Joint& from, const Affine<double>& child_in_world, ModelLink& link) {
    static const std::map<std::string, JointKind> kinds = {
        {"revolute", JointKind::hinge},  {"continuous", JointKind::hinge},
        {"prismatic", JointKind::slide}, {"ball", JointKind::ball},
        {"fixed", JointKind::fixed},     {"universal", JointKind::hinge},
        {"revolute2", JointKind::hinge}, {"screw", JointKind::hinge},
        {"gearbox", JointKind::hinge}};
    const std::string type = from.element->attribute_or("type");
    const auto kind = kinds.find(type);
    if (kind == kinds.end())
      return files_.wrong(*from.element,
                          "type: must be a joint's (got \"" + printable(type, 40) + "\")");
    if (type == "screw" || type == "gearbox")
      model_.pass_over("<joint type=\"" + type + "\">", "only turns here");
    const std::string own = from.element->attribute_or("name");
    const Affine<double> in_world = from.model_in_world * resolve(*from.scope, own, *from.element);
    const Affine<double> in_link = child_in_world.inverse() * in_world;
    const auto add = [&](const XmlElement* axis, const std::string& name) {
      ModelJoint joint;
      joint.name = name;
      joint.kind = kind->second;
      joint.anchor = in_link.translation;
      joint.axis = {0, 0, 1};
      if (axis) {
        if (const XmlElement* xyz = axis->child("xyz")) {
          const auto v = files_.numbers_in(*xyz, xyz->text, "xyz", 3, 3);
          if (v) joint.axis = {(*v)[0], (*v)[1], (*v)[2]};
          const std::string expressed = xyz->attribute_or("expressed_in");
          const bool in_model = text_of(*axis, "use_parent_model_frame") == "1" ||
                                text_of(*axis, "use_parent_model_frame") == "true";
          Mat3<double> turn = in_link.linear;
          if (in_model || !expressed.empty()) {
            const Affine<double> frame =
                from.model_in_world *
                (in_model ? Affine<double>() : resolve(*from.scope, expressed, *xyz));
            turn = child_in_world.linear.transpose() * frame.linear;
          }
          joint.axis = turn * joint.axis;
        }
        if (const XmlElement* limit = axis->child("limit")) {
          const auto bound = [&](const char* key, double otherwise) {
            const XmlElement* at = limit->child(key);
            const std::string text = at ? text_of(*limit, key) : "";
            if (text.empty() || text.find("inf") != text.npos) return otherwise;
            const auto v = files_.numbers_in(*at, text, key, 1, 1);
            return v ? (*v)[0] : otherwise;
          };
          joint.limits = {bound("lower", -1e16), bound("upper", 1e16)};
        }
      }
      joint.axis = unit(joint.axis);
      if (joint.axis.isZero(0)) files_.wrong(*from.element, "axis: must not be zero");
      link.joints.push_back(joint);
    };
    add(from.element->child("axis"), from.name);
    if (type == "universal" || type == "revolute2")
      add(from.element->child("axis2"), from.name + "/axis2");
  }

  void collect_meshes() {
    model_.hash = files_.hash_text();
    std::map<std::uint32_t, int> first;
    for (auto& [file, library] : libraries_) {
      first[file] = static_cast<int>(model_.meshes.size());
      model_.hash += library->hash_text();
      for (ModelMesh& mesh : library->take_meshes()) model_.meshes.push_back(std::move(mesh));
    }
  }

  XmlFiles& files_;
  const ImportOptions& options_;
  Model model_;
  bool has_content_ = false;
  int includes_ = 0;
  std::vector<std::unique_ptr<Scope>> scopes_;
  std::vector<std::unique_ptr<XmlElement>> included_;
  std::map<std::uint32_t, std::unique_ptr<MeshLibrary>> libraries_;
  std::vector<Joint> joints_;
  std::vector<const XmlElement*> elements_;  ///< of links, in their first order
  std::map<std::string, int> link_index_;
};

}  // namespace

Model read_sdf(const XmlElement& root, XmlFiles& files, const ImportOptions& options) {
  return SdfReader(files, options).read(root);
}

}  // namespace minkray
