// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf.h"

#include <algorithm>
#include <map>
#include <set>

#include "renderer/import/geometry_common.h"
#include "renderer/import/mjcf_assets.h"
#include "renderer/import/mjcf_compiler.h"
#include "renderer/import/mjcf_composite.h"
#include "renderer/import/mjcf_defaults.h"
#include "renderer/import/orientation.h"

namespace minkray {
namespace {

/// What surrounds an element of a body: its link, the pose of frames around it, default classes.
struct Around {
  int link = -1;
  Affine<double> frame = {};  ///< in the link's frame
  std::string child_class = {};
};

class MjcfReader {
 public:
  MjcfReader(XmlFiles& files, const ImportOptions& options)
      : files_(files), compiler_(files), assets_(model_, files, options) {}

  Model read(XmlElement root) {
    model_.format = "MJCF";
    model_.name = root.attribute_or("model");
    expand_includes(root, files_);
    for_each(root, "compiler", [&](const XmlElement& e) { compiler_.read(e); });
    assets_.look_in(files_.files().front().parent_path() / compiler_.mesh_folder(),
                    compiler_.strips_path());
    for_each(root, "default", [&](const XmlElement& e) { defaults_.read(e, files_, ""); });
    for_each(root, "asset", [&](const XmlElement& e) { assets_.read(e, defaults_); });
    for_each(root, "worldbody", [&](const XmlElement& e) { read_body_content(e, {}); });
    for_each(root, "keyframe", [&](const XmlElement& e) { read_keyframes(e); });
    for (const XmlElement& section : root.children) pass_over_section(section);
    // MuJoCo numbers the shapes of a body together.
    std::ranges::stable_sort(model_.geoms, {}, &ModelGeom::link);
    model_.hash = files_.hash_text();
    assets_.hand_over_meshes();
    return std::move(model_);
  }

 private:
  template <class Visit>
  void for_each(const XmlElement& root, std::string_view name, const Visit& visit) {
    for (const XmlElement& child : root.children)
      if (child.name == name) visit(child);
  }

  void pass_over_section(const XmlElement& section) {
    static const std::set<std::string> read = {"compiler", "default", "asset", "worldbody",
                                               "keyframe", "option",  "size",  "statistic",
                                               "visual",   "custom"};
    if (read.contains(section.name)) return;
    static const std::set<std::string> known = {"contact", "equality",  "tendon",    "actuator",
                                                "sensor",  "extension", "deformable"};
    if (!known.contains(section.name))
      files_.wrong(section, "is no section of MJCF (is it a file to be included?)");
    else if (!section.children.empty())
      model_.pass_over("<" + section.name + ">", "has no shape of its own",
                       section.children.size());
  }

  /// A pose in the link's frame, of one that the file gives in the link's or the world's.
  Affine<double> local(const Around& around, const Affine<double>& given) const {
    if (!compiler_.is_global()) return around.frame * given;
    return around.link < 0
               ? given
               : rest_in_world_[static_cast<std::size_t>(around.link)].inverse() * given;
  }

  /// What stands in a body, in <worldbody> or in a <frame>.
  void read_body_content(const XmlElement& body, const Around& around) {
    for (const XmlElement& child : body.children) {
      if (child.name == "geom") {
        read_geom(child, around);
      } else if (child.name == "body") {
        read_body(child, around);
      } else if (child.name == "frame") {
        Around inner = around;
        inner.frame = around.frame * compiler_.pose_in(child);
        if (const std::string* own = child.attribute("childclass")) inner.child_class = *own;
        read_body_content(child, inner);
      } else if (child.name == "joint" || child.name == "freejoint") {
        read_joint(child, around);
      } else if (child.name == "composite") {
        if (compiler_.is_global())
          files_.wrong(child, "needs coordinate=\"local\"");
        else
          add_composite(model_, around.link, child, files_,
                        [&](const XmlElement& geom) { return assets_.colour_of(geom); });
        follow_rests();
      } else if (child.name == "replicate" || child.name == "flexcomp" || child.name == "attach" ||
                 child.name == "plugin") {
        files_.wrong(child, "is not read: MuJoCo 2.2.2 does not have it");
      } else if (child.name == "site" || child.name == "camera" || child.name == "light" ||
                 child.name == "inertial") {
        if (child.name != "inertial")
          model_.pass_over("<" + child.name + ">", "is no shape of the scene");
      } else {
        files_.wrong(child, "is no element of a body");
      }
    }
  }

  void follow_rests() {
    for (std::size_t i = rest_in_world_.size(); i < model_.links.size(); ++i) {
      const ModelLink& link = model_.links[i];
      rest_in_world_.push_back(
          link.parent < 0 ? link.rest
                          : rest_in_world_[static_cast<std::size_t>(link.parent)] * link.rest);
    }
  }

  void read_body(const XmlElement& body, const Around& around) {
    if (compiler_.is_global() && !body.attribute("pos"))
      files_.wrong(body, "pos: must be there where coordinate is \"global\"");
    const Affine<double> rest = local(around, compiler_.pose_in(body));
    Around inner{static_cast<int>(model_.links.size()), {}, around.child_class};
    if (const std::string* own = body.attribute("childclass")) {
      inner.child_class = *own;
      if (!defaults_.has(*own))
        files_.wrong(
            body, "childclass: there are no defaults of the class \"" + printable(*own, 60) + "\"");
    }
    model_.links.push_back({body.attribute_or("name"), around.link, rest});
    follow_rests();
    read_body_content(body, inner);
  }

  void read_joint(const XmlElement& written, const Around& around) {
    if (around.link < 0) return files_.wrong(written, "must be in a body");
    const XmlElement e = written.name == "freejoint"
                             ? written
                             : defaults_.with_defaults(written, around.child_class, files_);
    static const std::map<std::string, JointKind> kinds = {{"hinge", JointKind::hinge},
                                                           {"slide", JointKind::slide},
                                                           {"ball", JointKind::ball},
                                                           {"free", JointKind::free}};
    const std::string type = written.name == "freejoint" ? "free" : e.attribute_or("type", "hinge");
    const auto kind = kinds.find(type);
    if (kind == kinds.end())
      return files_.wrong(written, "type: must be one of hinge, slide, ball and free (got \"" +
                                       printable(type, 40) + "\")");
    ModelLink& link = model_.links[static_cast<std::size_t>(around.link)];
    ModelJoint joint;
    joint.name = e.attribute_or("name");
    joint.kind = kind->second;
    if (joint.kind == JointKind::free) {
      if (link.parent >= 0)
        return files_.wrong(written, "a free joint's body must be in the world");
      link.joints.push_back(joint);
      return;
    }
    const auto given = files_.vector(e, "axis");
    Vec3<double> axis = given.value_or(Vec3<double>(0, 0, 1));
    Vec3<double> anchor = files_.vector(e, "pos").value_or(Vec3<double>::Zero());
    const Affine<double> frame = local(around, {});
    joint.axis = unit<double>(frame.linear * axis);
    joint.anchor = frame(anchor);
    if (joint.axis.isZero(0)) return files_.wrong(written, "axis: must not be zero");
    const bool turns = joint.kind == JointKind::hinge;
    if (const auto reference = files_.number(e, "ref"))
      joint.reference = turns ? compiler_.angle(*reference) : *reference;
    const std::string limited = e.attribute_or("limited", "auto");
    if (const auto range = files_.numbers(e, "range", 2, 2))
      if (limited == "true" || (limited == "auto" && compiler_.auto_limits()))
        joint.limits = turns
                           ? std::array{compiler_.angle((*range)[0]), compiler_.angle((*range)[1])}
                           : std::array{(*range)[0], (*range)[1]};
    link.joints.push_back(joint);
  }

  void read_geom(const XmlElement& written, const Around& around) {
    const XmlElement e = defaults_.with_defaults(written, around.child_class, files_);
    ModelGeom geom;
    geom.name = e.attribute_or("name");
    geom.kind = e.attribute_or("type", "sphere");
    geom.link = around.link;
    geom.rgba = assets_.colour_of(e);
    const double contype = files_.number(e, "contype").value_or(1);
    const double conaffinity = files_.number(e, "conaffinity").value_or(1);
    geom.collides = contype != 0 || conaffinity != 0;
    geom.is_seen = files_.number(e, "group").value_or(0) < 3 && geom.rgba[3] > 0;
    if (compiler_.discards_visual() && !geom.collides)
      return model_.pass_over("<geom>", "the compiler discards what does not collide");
    geom.pose = local(around, compiler_.pose_in(e));

    std::vector<double> size = {0, 0, 0};
    if (const auto given = files_.numbers(e, "size", 1, 3))
      std::copy(given->begin(), given->end(), size.begin());
    if (const auto ends = files_.numbers(e, "fromto", 6, 6)) {
      const bool is_long = geom.kind == "capsule" || geom.kind == "cylinder";
      if (!is_long && geom.kind != "ellipsoid" && geom.kind != "box")
        return files_.wrong(written, "fromto: is for capsules, cylinders, ellipsoids and boxes");
      const Vec3<double> from((*ends)[0], (*ends)[1], (*ends)[2]);
      const Vec3<double> to((*ends)[3], (*ends)[4], (*ends)[5]);
      const double length = (to - from).norm();
      if (!(length > 1e-15)) return files_.wrong(written, "fromto: must be two points");
      geom.pose = local(around, {rotation_of_z_to(from - to), (from + to) / 2});
      size[is_long ? 1 : 2] = length / 2;
      if (!is_long) size[1] = size[0];
    }
    if (geom.kind == "mesh") return assets_.add_mesh_geom(written, e, std::move(geom));
    if (e.attribute("mesh"))
      return files_.wrong(written, "a " + printable(geom.kind, 40) +
                                       " fitted to a mesh is not read; type=\"mesh\" is");
    if (geom.kind == "plane") {
      model_.geoms.push_back(std::move(geom));
      return;
    }
    static const std::map<std::string, std::size_t> sizes = {
        {"sphere", 1}, {"capsule", 2}, {"cylinder", 2}, {"ellipsoid", 3}, {"box", 3}};
    const auto needed = sizes.find(geom.kind);
    if (needed == sizes.end())
      return files_.wrong(written,
                          "type: must be one of plane, sphere, capsule, ellipsoid, cylinder, box "
                          "and mesh (got \"" +
                              printable(geom.kind, 40) + "\")");
    for (std::size_t i = 0; i < needed->second; ++i)
      if (!(size[i] > 0))
        return files_.wrong(written, "size: of a " + geom.kind + " must be " +
                                         counted_numbers(needed->second) + " > 0 (got \"" +
                                         printable(e.attribute_or("size"), 60) + "\")");
    geom.shape = geom.kind == "sphere"     ? sphere_of(size[0])
                 : geom.kind == "capsule"  ? capsule_of(size[0], size[1])
                 : geom.kind == "cylinder" ? cylinder_of(size[0], size[1])
                 : geom.kind == "box"      ? box_of({size[0], size[1], size[2]})
                                           : ellipsoid_of({size[0], size[1], size[2]});
    model_.geoms.push_back(std::move(geom));
  }

  void read_keyframes(const XmlElement& keyframes) {
    std::size_t width = 0;
    for (const ModelLink& link : model_.links)
      for (const ModelJoint& joint : link.joints) width += width_of(joint.kind);
    for (const XmlElement& key : keyframes.children) {
      model_.keyframes.push_back({key.attribute_or("name"), {}});
      // Without it all joints are at rest.
      if (key.attribute("qpos"))
        if (const auto values = files_.numbers(key, "qpos", width, width))
          model_.keyframes.back().values = *values;
    }
  }

  XmlFiles& files_;
  Model model_;
  MjcfCompiler compiler_;
  MjcfDefaults defaults_;
  MjcfAssets assets_;
  std::vector<Affine<double>> rest_in_world_;  ///< by link
};

}  // namespace

Model read_mjcf(XmlElement root, XmlFiles& files, const ImportOptions& options) {
  return MjcfReader(files, options).read(std::move(root));
}

}  // namespace minkray
