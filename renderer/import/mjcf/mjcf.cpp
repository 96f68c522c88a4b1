// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf/mjcf.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/mjcf/mjcf_assets.h"
#include "renderer/import/mjcf/mjcf_compiler.h"
#include "renderer/import/mjcf/mjcf_composite.h"
#include "renderer/import/mjcf/mjcf_defaults.h"
#include "renderer/import/mjcf/mjcf_geom.h"
#include "renderer/import/mjcf/mjcf_masses.h"
#include "renderer/import/mjcf/mjcf_newer.h"
#include "renderer/import/model/orientation.h"

namespace minkray {
namespace {

/// Replicas and attached models: each few lines of text can make any number of bodies.
constexpr double most_replicas = 100'000;
constexpr int deepest_content = 600;  ///< each level is one of the stack
constexpr int deepest_attachment = 32, most_attachments = 10'000;

/// Context of an element of a body: its link, the pose of frames around it, default classes, and
/// the additions of replicas and attached models to names.
struct Around {
  int link = -1;
  Affine<double> frame = {};  ///< in the link's frame
  std::string child_class = {};
  std::string prefix = {}, suffix = {};

  std::string named(const XmlElement& element) const {
    const std::string own = element.attribute_or("name");
    return own.empty() ? own : prefix + own + suffix;
  }
};

/// A file's settings, defaults and assets, which hold for its own elements only: of the model
/// itself, or of one that it attaches.
struct Source {
  Source(XmlElement from, Model& model, XmlFiles& files, const ImportOptions& options)
      : root(std::move(from)), compiler(files), assets(model, files, options) {}
  XmlElement root;
  MjcfCompiler compiler;
  MjcfDefaults defaults;
  MjcfAssets assets;
};

class MjcfReader {
 public:
  MjcfReader(XmlFiles& files, const ImportOptions& options) : files_(files), options_(options) {}

  Model read(XmlElement root) {
    model_.format = "MJCF";
    model_.name = root.attribute_or("model");
    source_ = open(std::move(root));
    const XmlElement& main = source_->root;
    for_each(main, "worldbody", [&](const XmlElement& e) { read_body_content(e, {}); });
    for_each(main, "keyframe", [&](const XmlElement& e) { read_keyframes(e); });
    for (const XmlElement& section : main.children) pass_over_section(section);
    // MuJoCo numbers the shapes of a body together.
    std::ranges::stable_sort(model_.geoms, {}, &ModelGeom::link);
    model_.hash = files_.hash_text();
    for (const auto& source : sources_) source->assets.hand_over_meshes();
    return std::move(model_);
  }

 private:
  /// Reads the settings of a file that apply to all of its elements.
  Source* open(XmlElement root) {
    expand_includes(root, files_);
    sources_.push_back(std::make_unique<Source>(std::move(root), model_, files_, options_));
    Source& source = *sources_.back();
    for_each(source.root, "compiler", [&](const XmlElement& e) { source.compiler.read(e); });
    source.assets.look_in(files_.files()[source.root.file].parent_path(),
                          source.compiler.mesh_folder(), source.compiler.strips_path());
    for_each(source.root, "default",
             [&](const XmlElement& e) { source.defaults.read(e, files_, ""); });
    for_each(source.root, "asset",
             [&](const XmlElement& e) { source.assets.read(e, source.defaults); });
    return &source;
  }

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
    static const std::set<std::string> known = {"contact",  "equality", "tendon",
                                                "actuator", "sensor",   "extension"};
    if (is_newer(section, model_, files_, options_)) return;
    if (!known.contains(section.name))
      files_.wrong(section, "not a section of MJCF (is it a file to be included?)");
    else if (!section.children.empty())
      model_.pass_over("<" + section.name + ">", "has no shape", section.children.size());
  }

  /// A pose in the link's frame, of one that the file gives in the link's or the world's.
  Affine<double> local(const Around& around, const Affine<double>& given) const {
    if (!source_->compiler.is_global()) return around.frame * given;
    return around.link < 0
               ? given
               : rest_in_world_[static_cast<std::size_t>(around.link)].inverse() * given;
  }

  /// Reads the contents of a body, of <worldbody> or of a <frame>.
  void read_body_content(const XmlElement& body, const Around& around) {
    if (nesting_ >= deepest_content)
      return files_.wrong(body, "is nested more than " + std::to_string(deepest_content) +
                                    " deep, with replicas and attached models around it");
    ++nesting_;
    read_children(body, around);
    --nesting_;
  }

  void read_children(const XmlElement& body, const Around& around) {
    for (const XmlElement& child : body.children) {
      if (child.name == "geom") {
        read_shapes(model_, files_, options_, [&] { read_geom(child, around); });
      } else if (child.name == "body") {
        read_body(child, around);
      } else if (child.name == "frame") {
        read_frame(child, around);
      } else if (child.name == "joint" || child.name == "freejoint") {
        read_joint(child, around);
      } else if (child.name == "composite") {
        if (source_->compiler.is_global())
          files_.wrong(child, "needs coordinate=\"local\"");
        else
          read_shapes(model_, files_, options_, [&] {
            add_composite(model_, around.link, child, files_,
                          [&](const XmlElement& geom) { return source_->assets.colour_of(geom); });
          });
        follow_rests();
      } else if (child.name == "replicate") {
        read_replicas(child, around);
      } else if (child.name == "attach") {
        read_attachment(child, around);
      } else if (is_newer(child, model_, files_, options_)) {
        continue;
      } else if (child.name == "plugin") {
        model_.pass_over("<plugin>", "has no shape");
      } else if (child.name == "site" || child.name == "camera" || child.name == "light" ||
                 child.name == "inertial") {
        if (child.name != "inertial") model_.pass_over("<" + child.name + ">", "not a shape");
      } else {
        files_.wrong(child, "not an element of a body");
      }
    }
  }

  /// Each replica is a turn and a step further than the one before it; the turn is about the first
  /// place, so that steps turn as well.
  void read_replicas(const XmlElement& element, const Around& around) {
    const auto count = files_.number(element, "count");
    if (!count || !(*count >= 0) || *count != std::floor(*count) || *count > most_replicas)
      return files_.wrong(element, "count: must be a whole number from 0 to 100,000");
    replicas_ += *count;
    if (replicas_ > most_replicas)
      return files_.wrong(element, "count: all replicas of a file must be at most 100,000");
    const Vec3<double> step = files_.vector(element, "offset").value_or(Vec3<double>::Zero());
    const Vec3<double> turn = files_.vector(element, "euler").value_or(Vec3<double>::Zero());
    const std::size_t digits = std::to_string(static_cast<int>(*count)).size();
    Affine<double> pose;
    for (int i = 0; i < static_cast<int>(*count); ++i) {
      pose.linear = source_->compiler.turn_of(i * turn);
      Around inner = around;
      inner.frame = around.frame * pose;
      if (const std::string* own = element.attribute("childclass")) inner.child_class = *own;
      std::string number = std::to_string(i);
      number.insert(0, digits - number.size(), '0');
      inner.suffix = element.attribute_or("sep") + number + around.suffix;
      read_body_content(element, inner);
      if (model_.geoms.size() > most_geoms || model_.links.size() > most_geoms)
        return files_.wrong(element, "makes more than " + std::to_string(most_geoms) +
                                         " bodies or shapes, with those before it");
      pose.translation += pose.linear * step;
    }
  }

  /// The element below of a kind and a name; null if there is none.
  static const XmlElement* find_below(const XmlElement& element, std::string_view kind,
                                      const std::string& name) {
    for (const XmlElement& child : element.children) {
      if (child.name == kind && child.attribute_or("name") == name) return &child;
      if (const XmlElement* found = find_below(child, kind, name)) return found;
    }
    return nullptr;
  }

  /// The model that an asset names, read once; null, and a mistake, if there is none.
  Source* source_of(const XmlElement& attach, const std::string& name) {
    const auto& models = source_->assets.models();
    const auto asset = models.find(name);
    if (asset == models.end()) {
      files_.wrong(attach, "model: no <model> is named \"" + printable(name, 60) + "\"");
      return nullptr;
    }
    const auto [known, is_new] = attached_.try_emplace(&asset->second, nullptr);
    if (!is_new) return known->second;
    const std::filesystem::path file = asset->second.attribute_or("file");
    std::filesystem::path found = files_.files()[source_->root.file].parent_path() / file;
    std::error_code error;
    if (!std::filesystem::exists(found, error))
      found = files_.files()[asset->second.file].parent_path() / file;
    auto root = files_.read(found);
    if (root && root->name != "mujoco") {
      files_.wrong(asset->second, "must be an MJCF file (got <" + printable(root->name, 40) + ">)");
      root.reset();
    }
    if (root) known->second = open(std::move(*root));
    return known->second;
  }

  /// A body, a frame or all of another model, under a prefix of all its names.
  void read_attachment(const XmlElement& attach, const Around& around) {
    if (depth_ > deepest_attachment || ++attachments_ > most_attachments)
      return files_.wrong(attach, "models are attached to each other too often, or in a cycle");
    const std::string* name = attach.attribute("model");
    Source* const from = name ? source_of(attach, *name) : source_;
    if (!from) return;
    const std::string* body = attach.attribute("body");
    const std::string* frame = attach.attribute("frame");
    Around inner = around;
    inner.prefix = around.prefix + attach.attribute_or("prefix");
    inner.child_class.clear();
    Source* const outer = std::exchange(source_, from);
    ++depth_;
    const XmlElement* part = nullptr;
    for_each(from->root, "worldbody", [&](const XmlElement& world) {
      if (!body && !frame)
        read_body_content(world, inner);
      else if (!part)
        part = find_below(world, body ? "body" : "frame", body ? *body : *frame);
    });
    if (part && body) read_body(*part, inner);
    if (part && !body) read_frame(*part, inner);
    source_ = outer;
    --depth_;
    if (!part && (body || frame))
      files_.wrong(attach, std::string(body ? "body" : "frame") + ": none is named \"" +
                               printable(body ? *body : *frame, 60) + "\" in the model");
  }

  void read_frame(const XmlElement& frame, const Around& around) {
    Around inner = around;
    inner.frame = around.frame * source_->compiler.pose_in(frame);
    if (const std::string* own = frame.attribute("childclass")) inner.child_class = *own;
    read_body_content(frame, inner);
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
    // With global coordinates, a body without a position is at its mass.
    const bool has_no_place = source_->compiler.is_global() && !body.attribute("pos");
    const XmlElement* inertial = has_no_place ? body.child("inertial") : nullptr;
    const Affine<double> given =
        inertial ? source_->compiler.pose_in(*inertial)
                 : (has_no_place ? Affine<double>() : source_->compiler.pose_in(body));
    const Affine<double> rest = local(around, given);
    Around inner = around;
    inner.link = static_cast<int>(model_.links.size());
    inner.frame = {};
    if (const std::string* own = body.attribute("childclass")) {
      inner.child_class = *own;
      if (!source_->defaults.has(*own))
        files_.wrong(body, "childclass: no defaults for class \"" + printable(*own, 60) + "\"");
    }
    model_.links.push_back({around.named(body), around.link, rest});
    follow_rests();
    if (has_no_place && !inertial) masses_.begin(inner.link);
    read_body_content(body, inner);
    if (has_no_place && !inertial) place_by_mass(body, inner.link);
  }

  void place_by_mass(const XmlElement& body, int link) {
    const auto frame = masses_.end(link);
    if (!frame)
      return files_.wrong(
          body, "pos: missing (required with coordinate=\"global\" unless geoms have a mass)");
    move_frame(model_, link, *frame);
    rest_in_world_[static_cast<std::size_t>(link)] =
        rest_in_world_[static_cast<std::size_t>(link)] * *frame;
  }

  void read_joint(const XmlElement& written, const Around& around) {
    if (around.link < 0) return files_.wrong(written, "must be in a body");
    const XmlElement e = written.name == "freejoint"
                             ? written
                             : source_->defaults.with_defaults(written, around.child_class, files_);
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
    joint.name = around.named(e);
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
      joint.reference = turns ? source_->compiler.angle(*reference) : *reference;
    const std::string limited = e.attribute_or("limited", "auto");
    if (const auto range = files_.numbers(e, "range", 2, 2))
      if (limited == "true" || (limited == "auto" && source_->compiler.auto_limits()))
        joint.limits = turns ? std::array{source_->compiler.angle((*range)[0]),
                                          source_->compiler.angle((*range)[1])}
                             : std::array{(*range)[0], (*range)[1]};
    link.joints.push_back(joint);
  }

  void read_geom(const XmlElement& written, const Around& around) {
    const XmlElement e = source_->defaults.with_defaults(written, around.child_class, files_);
    ModelGeom geom;
    geom.name = around.named(e);
    geom.link = around.link;
    const std::size_t before = model_.geoms.size();
    add_mjcf_geom(written, e, std::move(geom),
                  [&](const Affine<double>& given) { return local(around, given); },
                  {model_, files_, source_->compiler, source_->assets});
    if (!masses_.has(around.link)) return;
    for (std::size_t i = before; i < model_.geoms.size(); ++i)
      if (model_.geoms[i].shape)
        masses_.add(model_.geoms[i], files_.number(e, "mass"),
                    files_.number(e, "density").value_or(1000));
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
  const ImportOptions& options_;
  Model model_;
  Source* source_ = nullptr;  ///< of what is read now
  std::vector<std::unique_ptr<Source>> sources_;
  std::map<const XmlElement*, Source*> attached_;  ///< by the <model> that names them
  double replicas_ = 0;
  int nesting_ = 0;
  int depth_ = 0;  ///< of attached models around what is read now
  int attachments_ = 0;
  std::vector<Affine<double>> rest_in_world_;  ///< by link
  GeomMasses masses_;                          ///< of links without a place
};

}  // namespace

Model read_mjcf(XmlElement root, XmlFiles& files, const ImportOptions& options) {
  return MjcfReader(files, options).read(std::move(root));
}

}  // namespace minkray
