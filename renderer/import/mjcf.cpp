// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf.h"

#include <algorithm>
#include <numbers>

#include "renderer/import/geometry_common.h"
#include "renderer/import/mesh_library.h"
#include "renderer/import/mjcf_composite.h"
#include "renderer/import/mjcf_defaults.h"
#include "renderer/import/orientation.h"

namespace minkray {
namespace {

using Rgba = std::array<double, 4>;
constexpr Rgba default_rgba = {0.5, 0.5, 0.5, 1};

struct Compiler {
  bool is_degree = true, is_global = false, auto_limits = false, discard_visual = false;
  bool strips_path = false;
  std::string mesh_folder, euler = "xyz";
};

/// What surrounds an element of a body: its link, the pose of frames around it, default classes.
struct Around {
  int link = -1;
  Affine<double> frame = {};  ///< in the link's frame
  std::string child_class = {};
};

struct MeshAsset {
  XmlElement element;  ///< with its defaults
};

class MjcfReader {
 public:
  MjcfReader(XmlFiles& files, const ImportOptions& options)
      : files_(files), options_(options), meshes_(std::filesystem::path(), options) {}

  Model read(XmlElement root) {
    model_.format = "MJCF";
    model_.name = root.attribute_or("model");
    expand_includes(root, files_);
    for_each(root, "compiler", [&](const XmlElement& e) { read_compiler(e); });
    meshes_ = MeshLibrary(files_.files().front().parent_path() / compiler_.mesh_folder, options_);
    for_each(root, "default", [&](const XmlElement& e) { defaults_.read(e, files_, ""); });
    for_each(root, "asset", [&](const XmlElement& e) { read_assets(e); });
    for_each(root, "worldbody", [&](const XmlElement& e) { read_body_content(e, {}); });
    for_each(root, "keyframe", [&](const XmlElement& e) { read_keyframes(e); });
    for (const XmlElement& section : root.children) pass_over_section(section);
    // MuJoCo numbers the shapes of a body together.
    std::ranges::stable_sort(model_.geoms, {}, &ModelGeom::link);
    model_.meshes = meshes_.take_meshes();
    model_.hash = files_.hash_text() + meshes_.hash_text();
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

  bool flag(const XmlElement& element, std::string_view key, bool otherwise) {
    const std::string* text = element.attribute(key);
    if (!text) return otherwise;
    if (*text != "true" && *text != "false" && *text != "auto")
      files_.wrong(element, std::string(key) + ": must be true or false (got \"" +
                                printable(*text, 40) + "\")");
    return *text == "true";
  }

  void read_compiler(const XmlElement& e) {
    if (const std::string* angle = e.attribute("angle")) {
      compiler_.is_degree = *angle == "degree";
      if (*angle != "degree" && *angle != "radian")
        files_.wrong(e, "angle: must be degree or radian (got \"" + printable(*angle, 40) + "\")");
    }
    if (const std::string* coordinate = e.attribute("coordinate"))
      compiler_.is_global = *coordinate == "global";
    if (const std::string* folder = e.attribute("assetdir")) compiler_.mesh_folder = *folder;
    if (const std::string* folder = e.attribute("meshdir")) compiler_.mesh_folder = *folder;
    if (const std::string* euler = e.attribute("eulerseq")) {
      if (euler->size() == 3 && euler->find_first_not_of("xyzXYZ") == euler->npos)
        compiler_.euler = *euler;
      else
        files_.wrong(e, "eulerseq: must be three of x, y, z, X, Y, Z");
    }
    compiler_.auto_limits = flag(e, "autolimits", compiler_.auto_limits);
    compiler_.discard_visual = flag(e, "discardvisual", compiler_.discard_visual);
    compiler_.strips_path = flag(e, "strippath", compiler_.strips_path);
  }

  void read_assets(const XmlElement& assets) {
    std::map<std::string, Rgba> textures;
    for (const XmlElement& asset : assets.children) {
      if (asset.name != "texture" || !asset.attribute("builtin")) continue;
      const auto one = files_.vector(asset, "rgb1"), two = files_.vector(asset, "rgb2");
      const Vec3<double> a = one.value_or(Vec3<double>::Constant(0.8)),
                         b = two.value_or(Vec3<double>::Constant(0.5));
      const bool is_flat = asset.attribute_or("builtin") == "flat";
      const Vec3<double> mean = is_flat ? a : Vec3<double>((a + b) / 2);
      textures[asset.attribute_or("name")] = {mean.x(), mean.y(), mean.z(), 1};
    }
    for (const XmlElement& written : assets.children) {
      const XmlElement asset = defaults_.with_defaults(written, "", files_);
      if (asset.name == "mesh") {
        std::string name = asset.attribute_or("name");
        if (name.empty()) name = std::filesystem::path(asset.attribute_or("file")).stem().string();
        if (name.empty()) files_.wrong(written, "must have a name or a file");
        if (!mesh_assets_.emplace(name, MeshAsset{asset}).second)
          files_.wrong(written, "name: must not be the name of two meshes");
      } else if (asset.name == "material") {
        Rgba rgba = {1, 1, 1, 1};
        if (const auto given = read_rgba(asset)) rgba = *given;
        const auto texture = textures.find(asset.attribute_or("texture"));
        if (texture != textures.end())
          for (std::size_t i = 0; i < 3; ++i) rgba[i] *= texture->second[i];
        materials_[asset.attribute_or("name")] = rgba;
      } else {
        model_.pass_over("<" + printable(asset.name, 40) + ">", asset.name == "texture"
                                                                    ? "surfaces have one colour"
                                                                    : "is no convex shape");
      }
    }
  }

  std::optional<Rgba> read_rgba(const XmlElement& element) {
    const auto v = files_.numbers(element, "rgba", 3, 4);
    if (!v) return std::nullopt;
    return Rgba{(*v)[0], (*v)[1], (*v)[2], v->size() > 3 ? (*v)[3] : 1};
  }

  /// A geom has its own colour, if it says one, or its material's.
  Rgba colour_of(const XmlElement& geom) {
    const Rgba own = read_rgba(geom).value_or(default_rgba);
    const auto material = materials_.find(geom.attribute_or("material"));
    return own == default_rgba && material != materials_.end() ? material->second : own;
  }

  double angle(double given) const {
    return compiler_.is_degree ? given * (std::numbers::pi / 180) : given;
  }

  Vec3<double> direction(const XmlElement& element, std::string_view key,
                         const std::vector<double>& v, std::size_t first) {
    const Vec3<double> d = unit<double>({v[first], v[first + 1], v[first + 2]});
    if (d.isZero(0)) files_.wrong(element, std::string(key) + ": must not be zero");
    return d.isZero(0) ? Vec3<double>(0, 0, 1) : d;
  }

  Mat3<double> rotation_in(const XmlElement& e) {
    if (const auto q = files_.numbers(e, "quat", 4, 4)) {
      if ((*q)[0] != 0 || (*q)[1] != 0 || (*q)[2] != 0 || (*q)[3] != 0)
        return rotation_matrix_of_any((*q)[1], (*q)[2], (*q)[3], (*q)[0]);
      files_.wrong(e, "quat: must not be zero");
    }
    if (const auto v = files_.numbers(e, "axisangle", 4, 4))
      return rotation_about(direction(e, "axisangle", *v, 0), angle((*v)[3]));
    if (const auto v = files_.numbers(e, "euler", 3, 3))
      return rotation_of_euler({angle((*v)[0]), angle((*v)[1]), angle((*v)[2])}, compiler_.euler);
    if (const auto v = files_.numbers(e, "xyaxes", 6, 6)) {
      const Vec3<double> x = direction(e, "xyaxes", *v, 0), y = direction(e, "xyaxes", *v, 3);
      if (x.cross(y).norm() > 1e-10) return rotation_of_xy(x, y);
      files_.wrong(e, "xyaxes: must not be parallel");
    }
    if (const auto v = files_.numbers(e, "zaxis", 3, 3))
      return rotation_of_z_to(direction(e, "zaxis", *v, 0));
    return Mat3<double>::Identity();
  }

  Affine<double> pose_in(const XmlElement& e) {
    return {rotation_in(e), files_.vector(e, "pos").value_or(Vec3<double>::Zero())};
  }

  /// A pose in the link's frame, of one that the file gives in the link's or the world's.
  Affine<double> local(const Around& around, const Affine<double>& given) const {
    if (!compiler_.is_global) return around.frame * given;
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
        inner.frame = around.frame * pose_in(child);
        if (const std::string* own = child.attribute("childclass")) inner.child_class = *own;
        read_body_content(child, inner);
      } else if (child.name == "joint" || child.name == "freejoint") {
        read_joint(child, around);
      } else if (child.name == "composite") {
        if (compiler_.is_global)
          files_.wrong(child, "needs coordinate=\"local\"");
        else
          add_composite(model_, around.link, child, files_,
                        [&](const XmlElement& geom) { return colour_of(geom); });
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
    if (compiler_.is_global && !body.attribute("pos"))
      files_.wrong(body, "pos: must be there where coordinate is \"global\"");
    const Affine<double> rest = local(around, pose_in(body));
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
      joint.reference = turns ? angle(*reference) : *reference;
    const std::string limited = e.attribute_or("limited", "auto");
    if (const auto range = files_.numbers(e, "range", 2, 2))
      if (limited == "true" || (limited == "auto" && compiler_.auto_limits))
        joint.limits = turns ? std::array{angle((*range)[0]), angle((*range)[1])}
                             : std::array{(*range)[0], (*range)[1]};
    link.joints.push_back(joint);
  }

  void read_geom(const XmlElement& written, const Around& around) {
    const XmlElement e = defaults_.with_defaults(written, around.child_class, files_);
    ModelGeom geom;
    geom.name = e.attribute_or("name");
    geom.kind = e.attribute_or("type", "sphere");
    geom.link = around.link;
    geom.rgba = colour_of(e);
    const double contype = files_.number(e, "contype").value_or(1);
    const double conaffinity = files_.number(e, "conaffinity").value_or(1);
    geom.collides = contype != 0 || conaffinity != 0;
    geom.is_seen = files_.number(e, "group").value_or(0) < 3 && geom.rgba[3] > 0;
    if (compiler_.discard_visual && !geom.collides)
      return model_.pass_over("<geom>", "the compiler discards what does not collide");
    geom.pose = local(around, pose_in(e));

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
    if (geom.kind == "mesh") return read_mesh_geom(written, e, std::move(geom));
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
                                         std::to_string(needed->second) + " numbers > 0 (got \"" +
                                         printable(e.attribute_or("size"), 60) + "\")");
    geom.shape = geom.kind == "sphere"     ? sphere_of(size[0])
                 : geom.kind == "capsule"  ? capsule_of(size[0], size[1])
                 : geom.kind == "cylinder" ? cylinder_of(size[0], size[1])
                 : geom.kind == "box"      ? box_of({size[0], size[1], size[2]})
                                           : ellipsoid_of({size[0], size[1], size[2]});
    model_.geoms.push_back(std::move(geom));
  }

  void read_mesh_geom(const XmlElement& written, const XmlElement& e, ModelGeom geom) {
    const std::string name = e.attribute_or("mesh");
    const auto found = mesh_assets_.find(name);
    if (found == mesh_assets_.end())
      return files_.wrong(written,
                          "mesh: there is no <mesh> of the name \"" + printable(name, 60) + "\"");
    const XmlElement& asset = found->second.element;
    const Vec3<double> scale = files_.vector(asset, "scale").value_or(Vec3<double>::Ones());
    MeshLibrary::Answer answer;
    // Vertices are moved and turned before they are scaled.
    Affine<double> before;
    if (const auto q = files_.numbers(asset, "refquat", 4, 4))
      before.linear = rotation_matrix_of_any((*q)[1], (*q)[2], (*q)[3], (*q)[0]).transpose();
    if (const auto p = files_.vector(asset, "refpos")) before.translation = -(before.linear * *p);
    const bool moves = !(before == Affine<double>());
    const Vec3<double> scale_of_vertices = moves ? Vec3<double>::Ones() : scale;
    if (asset.attribute("vertex")) {
      const auto numbers = files_.numbers(asset, "vertex", 12, 3'000'000);
      if (!numbers) return;
      std::vector<Vec3<double>> vertices;
      for (std::size_t i = 0; i + 2 < numbers->size(); i += 3)
        vertices.emplace_back((*numbers)[i], (*numbers)[i + 1], (*numbers)[i + 2]);
      answer = meshes_.hull_of_vertices(std::move(vertices), scale_of_vertices, name);
    } else {
      std::string file = asset.attribute_or("file");
      if (compiler_.strips_path) file = std::filesystem::path(file).filename().string();
      answer = meshes_.hulls_of(file, scale_of_vertices);
    }
    if (moves)
      for (Shape<double>& hull : answer.hulls)
        hull = Transform<double>{hull, Affine<double>{scale.asDiagonal(), {0, 0, 0}} * before};
    add_mesh(model_, files_, written, answer, std::move(geom), options_);
  }

  void read_keyframes(const XmlElement& keyframes) {
    std::size_t width = 0;
    for (const ModelLink& link : model_.links)
      for (const ModelJoint& joint : link.joints) width += width_of(joint.kind);
    for (std::size_t i = 0; i < keyframes.children.size(); ++i) {
      const XmlElement& key = keyframes.children[i];
      if (!key.attribute("qpos")) continue;
      const auto values = files_.numbers(key, "qpos", width, width);
      if (!values) continue;
      // Keys without a name are known by their number.
      model_.keyframes[key.attribute_or("name", std::to_string(model_.keyframes.size()))] = *values;
    }
  }

  XmlFiles& files_;
  const ImportOptions& options_;
  MeshLibrary meshes_;
  Model model_;
  Compiler compiler_;
  MjcfDefaults defaults_;
  std::map<std::string, MeshAsset> mesh_assets_;
  std::map<std::string, Rgba> materials_;
  std::vector<Affine<double>> rest_in_world_;  ///< by link
};

}  // namespace

Model read_mjcf(XmlElement root, XmlFiles& files, const ImportOptions& options) {
  return MjcfReader(files, options).read(std::move(root));
}

}  // namespace minkray
