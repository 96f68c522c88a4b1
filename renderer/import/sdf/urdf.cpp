// SPDX-License-Identifier: MIT
#include "renderer/import/sdf/urdf.h"

#include <map>

#include "renderer/image/colour.h"
#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/mesh/mesh_library.h"
#include "renderer/import/model/floating_joint.h"
#include "renderer/import/model/orientation.h"

namespace minkray {
namespace {

/// A parent of this name is the world, unless a link has the name.
constexpr const char* world_name = "world";

class UrdfReader {
 public:
  UrdfReader(XmlFiles& files, const ImportOptions& options)
      : files_(files), meshes_(files.files().front().parent_path(), options), options_(options) {}

  Model read(const XmlElement& robot) {
    model_.format = "URDF";
    model_.name = robot.attribute_or("name");
    for (const XmlElement& child : robot.children)
      if (child.name.starts_with("xacro:")) {
        // Elements between macros cannot be judged.
        files_.wrong(child, "is a macro: expand the file first (xacro robot.urdf.xacro)");
        return {};
      }
    for (const XmlElement& child : robot.children)
      if (child.name == "material")
        read_shapes(model_, files_, options_, [&] { read_material(child); });
    for (const XmlElement& child : robot.children) {
      if (child.name == "link") {
        const std::string name = child.attribute_or("name");
        if (name.empty()) files_.wrong(child, "name: missing");
        if (!link_elements_.emplace(name, &child).second)
          files_.wrong(child, "name: duplicate link");
        else
          link_order_.push_back(name);
      } else if (child.name == "joint") {
        read_joint(child);
      } else if (child.name != "material") {
        model_.pass_over("<" + printable(child.name, 40) + ">", "not a geometry");
      }
    }
    if (link_order_.empty()) files_.wrong(robot, "must have links");
    if (!link_elements_.contains(world_name)) welds_to_world_ = true;
    check_joints();
    add_links();
    if (const std::string lost = follow_mimics(model_); !lost.empty())
      files_.wrong(robot,
                   "mimic: the joint \"" + printable(lost, 60) +
                       "\" not found, or joints mimic each other in a cycle or through more than " +
                       std::to_string(longest_mimicry) + " others");
    model_.hash = files_.hash_text();
    meshes_.hand_over(model_);
    return std::move(model_);
  }

 private:
  struct Joint {
    const XmlElement* element;
    std::string parent;
    Affine<double> origin;
    ModelJoint joint;
    std::optional<ModelJoint> second = {};  ///< of a universal joint
  };

  std::optional<Rgba> read_material(const XmlElement& material) {
    const std::string name = material.attribute_or("name");
    if (const XmlElement* colour = material.child("color")) {
      if (const auto v = files_.numbers(*colour, "rgba", 3, 4)) {
        const Rgba rgba = {(*v)[0], (*v)[1], (*v)[2], v->size() > 3 ? (*v)[3] : 1};
        if (!name.empty()) materials_.emplace(name, rgba);
        return rgba;
      }
    }
    const auto known = materials_.find(name);
    if (known != materials_.end()) return known->second;
    if (material.child("texture"))
      model_.pass_over("<texture>", "surfaces have one colour");
    else if (!name.empty())
      model_.pass_over("<material>", "unknown colour \"" + printable(name, 60) + "\"");
    return std::nullopt;
  }

  Affine<double> origin_of(const XmlElement& element) {
    Affine<double> pose;
    const XmlElement* origin = element.child("origin");
    if (!origin) return pose;
    if (const auto xyz = files_.vector(*origin, "xyz")) pose.translation = *xyz;
    if (const auto rpy = files_.vector(*origin, "rpy")) pose.linear = rotation_of_rpy(*rpy);
    if (const auto q = files_.numbers(*origin, "quat_xyzw", 4, 4))
      pose.linear = rotation_of_quaternion((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
    return pose;
  }

  void read_joint(const XmlElement& element) {
    // The standard's, and those that Bullet and Drake have added.
    static const std::map<std::string, JointKind> kinds = {
        {"revolute", JointKind::hinge},  {"continuous", JointKind::hinge},
        {"prismatic", JointKind::slide}, {"fixed", JointKind::fixed},
        {"floating", JointKind::free},   {"planar", JointKind::planar},
        {"spherical", JointKind::ball},  {"ball", JointKind::ball},
        {"universal", JointKind::hinge}, {"screw", JointKind::hinge}};
    Joint read{&element, {}, origin_of(element), {}, {}};
    read.joint.name = element.attribute_or("name");
    const std::string type = element.attribute_or("type");
    const auto kind = kinds.find(type);
    if (kind == kinds.end()) {
      files_.wrong(element,
                   "type: must be one of revolute, continuous, prismatic, fixed, floating, "
                   "planar, spherical, universal and screw (got \"" +
                       printable(type, 40) + "\")");
    } else {
      read.joint.kind = kind->second;
      if (type == "screw") model_.pass_over("<joint type=\"screw\">", "only turns here");
    }
    const auto link_of = [&](const char* end) {
      const XmlElement* at = element.child(end);
      const std::string name = at ? at->attribute_or("link") : "";
      if (name.empty()) files_.wrong(element, std::string(end) + ": must name a link");
      return name;
    };
    read.parent = link_of("parent");
    const std::string child = link_of("child");
    read.joint.axis = {1, 0, 0};
    if (const XmlElement* axis = element.child("axis")) {
      if (const auto xyz = files_.vector(*axis, "xyz")) {
        const Vec3<double> direction = unit(*xyz);
        if (direction.isZero(0) && read.joint.kind != JointKind::fixed &&
            read.joint.kind != JointKind::free && read.joint.kind != JointKind::ball &&
            type != "universal")
          files_.wrong(*axis, "xyz: must not be zero");
        read.joint.axis = direction;
      }
    }
    if (const XmlElement* limit = element.child("limit"); limit && type != "continuous") {
      const auto lower = files_.number(*limit, "lower"), upper = files_.number(*limit, "upper");
      if (lower || upper) read.joint.limits = {lower.value_or(0), upper.value_or(0)};
    }
    if (const XmlElement* mimic = element.child("mimic")) {
      read.joint.mimic =
          Mimic{mimic->attribute_or("joint"), files_.number(*mimic, "multiplier").value_or(1),
                files_.number(*mimic, "offset").value_or(0)};
    }
    if (type == "universal") {
      // First about x, then about the y that is turned with it.
      read.joint.axis = {1, 0, 0};
      read.second = ModelJoint{read.joint.name + "/axis2", JointKind::hinge, {0, 1, 0}};
    }
    if (child.empty()) return;
    if (!joint_of_child_.emplace(child, read).second)
      files_.wrong(element, "child: the link \"" + printable(child, 60) +
                                "\" must not be the child of two joints");
  }

  void check_joints() {
    for (const auto& [child, joint] : joint_of_child_)
      for (const std::string& name : {child, joint.parent}) {
        if (name.empty() || link_elements_.contains(name)) continue;
        if (welds_to_world_ && &name != &child && name == world_name) continue;
        files_.wrong(*joint.element, "the link \"" + printable(name, 60) + "\" not found");
        is_link_missing_ = true;
      }
  }

  bool is_root(const std::string& link) const {
    const auto joint = joint_of_child_.find(link);
    return joint == joint_of_child_.end() ||
           (welds_to_world_ && joint->second.parent == world_name);
  }

  /// Roots first, each link behind its parent.
  void add_links() {
    std::map<std::string, std::vector<std::string>> children;
    std::vector<std::string> open;
    for (const std::string& name : link_order_) {
      if (is_root(name))
        open.push_back(name);
      else
        children[joint_of_child_.at(name).parent].push_back(name);
    }
    const auto roots = std::ranges::count_if(
        open, [&](const std::string& name) { return !joint_of_child_.contains(name); });
    if (roots > 1)
      model_.pass_over("links without a parent",
                       "more than one: each is placed at the origin of the world",
                       static_cast<std::size_t>(roots));
    std::ranges::reverse(open);
    std::map<std::string, int> index;
    while (!open.empty()) {
      const std::string name = open.back();
      open.pop_back();
      ModelLink link{name, -1, {}};
      const auto joint = joint_of_child_.find(name);
      if (joint != joint_of_child_.end()) {
        if (!is_root(name)) link.parent = index[joint->second.parent];
        link.rest = joint->second.origin;
        if (joint->second.joint.kind == JointKind::free &&
            !(is_still(link) && is_world(link.parent)))
          link.joints = floating_joints(joint->second.joint.name);
        else
          link.joints.push_back(joint->second.joint);
        if (joint->second.second) link.joints.push_back(*joint->second.second);
      }
      index[name] = static_cast<int>(model_.links.size());
      model_.links.push_back(std::move(link));
      add_geoms(*link_elements_[name], index[name]);
      const auto& next = children[name];
      open.insert(open.end(), next.rbegin(), next.rend());
    }
    // Links below a missing one were reported.
    if (is_link_missing_ || model_.links.size() == link_order_.size()) return;
    for (const std::string& name : link_order_)
      if (!index.contains(name)) {
        files_.wrong(*joint_of_child_.at(name).element, "joints must not form a cycle");
        return;
      }
  }

  /// True if the link's frame is always its parent's.
  static bool is_still(const ModelLink& link) {
    return link.rest.translation.isZero(0) && link.rest.linear.isIdentity(0) &&
           std::ranges::all_of(link.joints,
                               [](const ModelJoint& one) { return one.kind == JointKind::fixed; });
  }

  /// True if the link's frame is always the world's.
  bool is_world(int link) const {
    while (link >= 0 && is_still(model_.links[static_cast<std::size_t>(link)]))
      link = model_.links[static_cast<std::size_t>(link)].parent;
    return link < 0;
  }

  static std::vector<ModelJoint> floating_joints(const std::string& name) {
    std::vector<ModelJoint> joints;
    for (const std::string& slide : slides_of_floating(name))
      joints.push_back(
          {slide, JointKind::slide, Vec3<double>::Unit(static_cast<Eigen::Index>(joints.size()))});
    joints.push_back({name, JointKind::ball});
    return joints;
  }

  void add_geoms(const XmlElement& link, int index) {
    for (const XmlElement& child : link.children) {
      if (child.name == "visual" || child.name == "collision") {
        read_shapes(model_, files_, options_, [&] { add_geom(child, index); });
      } else if (child.name != "inertial" && child.name != "contact") {
        model_.pass_over("<link><" + printable(child.name, 40) + ">", "not a geometry");
      }
    }
  }

  void add_geom(const XmlElement& element, int link) {
    ModelGeom geom;
    geom.link = link;
    geom.name = element.attribute_or("name");
    geom.is_seen = element.name == "visual";
    geom.collides = !geom.is_seen;
    geom.pose = origin_of(element);
    Colouring colouring = Colouring::of_mesh;
    if (const XmlElement* material = element.child("material"))
      if (const auto rgba = read_material(*material)) {
        geom.rgba = *rgba;
        colouring = Colouring::of_robot;
      }
    const XmlElement* geometry = element.child("geometry");
    if (!geometry || geometry->children.empty()) {
      files_.wrong(element, "geometry: must hold a shape");
      return;
    }
    // One shape is legal; some files have several.
    for (const XmlElement& shape : geometry->children) add_shape(shape, geom, colouring);
  }

  void add_shape(const XmlElement& shape, ModelGeom geom, Colouring colouring) {
    geom.kind = shape.name;
    ShapeNumbers numbers(files_, shape);
    if (shape.name == "box") {
      geom.shape = box_of(numbers.sizes("size") / 2);
    } else if (shape.name == "sphere") {
      geom.shape = sphere_of(numbers.size("radius"));
    } else if (shape.name == "cylinder") {
      geom.shape = cylinder_of(numbers.size("radius"), numbers.size("length") / 2);
    } else if (shape.name == "capsule") {
      geom.shape = capsule_of(numbers.size("radius"), numbers.size("length") / 2);
    } else if (shape.name == "cone") {
      geom.shape = cone_of(numbers.size("radius"), numbers.size("length") / 2);
    } else if (shape.name == "ellipsoid") {
      geom.shape = ellipsoid_of(
          numbers.has("a") ? Vec3<double>(numbers.size("a"), numbers.size("b"), numbers.size("c"))
                           : numbers.sizes("radii"));
    } else if (shape.name == "plane") {
      const Vec3<double> normal = files_.vector(shape, "normal").value_or(Vec3<double>(0, 0, 1));
      if (unit(normal).isZero(0)) return files_.wrong(shape, "normal: must not be zero");
      geom.pose.linear = geom.pose.linear * rotation_of_z_to(normal);
    } else if (shape.name == "mesh") {
      const std::string* file = shape.attribute("filename");
      if (!file) return files_.wrong(shape, "filename: missing");
      const Vec3<double> scale = files_.vector(shape, "scale").value_or(Vec3<double>::Ones());
      add_mesh(model_, files_, shape, meshes_.parts_of(*file, scale), std::move(geom), options_,
               colouring);
      return;
    } else {
      return files_.wrong(
          shape, "must be one of box, sphere, cylinder, capsule, cone, ellipsoid, plane and mesh");
    }
    if (numbers.all_good()) model_.geoms.push_back(std::move(geom));
  }

  XmlFiles& files_;
  MeshLibrary meshes_;
  const ImportOptions& options_;
  Model model_;
  std::map<std::string, Rgba> materials_;
  std::map<std::string, const XmlElement*> link_elements_;
  std::vector<std::string> link_order_;
  std::map<std::string, Joint> joint_of_child_;
  bool welds_to_world_ = false;  ///< joints may have the parent "world"
  bool is_link_missing_ = false;
};

}  // namespace

Model read_urdf(XmlElement robot, XmlFiles& files, const ImportOptions& options) {
  drop_vendor_prefixes(robot);
  return UrdfReader(files, options).read(robot);
}

}  // namespace minkray
