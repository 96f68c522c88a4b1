// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf/mjcf_composite.h"

#include <cmath>
#include <numbers>

#include "core/files/text.h"
#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/mjcf/mjcf_composite_plan.h"
#include "renderer/import/model/orientation.h"

namespace minkray {
namespace {

class Composite {
 public:
  Composite(Model& model, CompositePlan plan, const XmlElement& element, XmlFiles& files)
      : model_(model), plan_(std::move(plan)), element_(element), files_(files) {}

  void add(int body) {
    if (plan_.hides_skin) model_.pass_over("<composite><skin>", "not a convex shape");
    if (plan_.type == "particle")
      add_particles(body);
    else if (plan_.type == "grid")
      add_grid(body);
    else if (plan_.type == "rope" || plan_.type == "loop")
      add_rope(body);
    else if (plan_.type == "cloth")
      add_cloth(body);
    else
      add_shell(body);
  }

 private:
  int add_link(int parent, const std::string& name, const Affine<double>& rest) {
    model_.links.push_back({name, parent, rest});
    return static_cast<int>(model_.links.size()) - 1;
  }

  void add_geom(int link, const std::string& name, const Affine<double>& pose) {
    plan_.geom.link = link;
    plan_.geom.name = name;
    plan_.geom.pose = pose;
    model_.geoms.push_back(plan_.geom);
  }

  ModelJoint& add_joint(int link, const std::string& name, JointKind kind, const Vec3<double>& axis,
                        const Vec3<double>& anchor) {
    std::vector<ModelJoint>& joints = model_.links[static_cast<std::size_t>(link)].joints;
    joints.push_back({name, kind, axis, anchor});
    return joints.back();
  }

  std::string named(const char* letter, int ix, int iy = -1, int iz = -1) const {
    std::string name = plan_.prefix + letter + std::to_string(ix);
    if (iy >= 0) name += "_" + std::to_string(iy);
    if (iz >= 0) name += "_" + std::to_string(iz);
    return name;
  }

  void add_slides(int link, const std::string& suffix) {
    for (int i = 0; i < 3; ++i)
      add_joint(link, suffix.empty() ? "" : plan_.prefix + "J" + std::to_string(i) + suffix,
                JointKind::slide, Vec3<double>::Unit(i), Vec3<double>::Zero());
  }

  void add_particles(int body) {
    for (int ix = 0; ix < plan_.count[0]; ++ix)
      for (int iy = 0; iy < plan_.count[1]; ++iy)
        for (int iz = 0; iz < plan_.count[2]; ++iz) {
          const Vec3<double> half(0.5 * plan_.count[0], 0.5 * plan_.count[1], 0.5 * plan_.count[2]);
          const Vec3<double> at = plan_.offset + plan_.spacing * (Vec3<double>(ix, iy, iz) - half);
          const int link = add_link(body, "", {Mat3<double>::Identity(), at});
          add_slides(link, "");
          add_geom(link, "", {});
        }
  }

  void add_grid(int body) {
    for (int ix = 0; ix < plan_.count[0]; ++ix)
      for (int iy = 0; iy < plan_.count[1]; ++iy) {
        const Vec3<double> at =
            plan_.offset +
            plan_.spacing * Vec3<double>(ix - 0.5 * plan_.count[0], iy - 0.5 * plan_.count[1], 0);
        const int link = add_link(body, named("B", ix, iy), {Mat3<double>::Identity(), at});
        add_geom(link, named("G", ix, iy), {});
        if (!plan_.pins.contains({ix, iy}))
          add_slides(link, "_" + std::to_string(ix) + "_" + std::to_string(iy));
      }
  }

  /// True if the parent body has the name that begins a rope or cloth: "B3" or "B3_5".
  bool read_origin(int body, int& ox, int& oy) {
    const std::string name = body < 0 ? "" : model_.links[static_cast<std::size_t>(body)].name;
    const bool is_cloth = plan_.type == "cloth";
    const std::string start = plan_.prefix + "B";
    oy = 0;
    const bool begins = name.starts_with(start);
    std::string_view rest = name;
    rest.remove_prefix(begins ? start.size() : rest.size());
    bool reads = take_number(rest, ox);
    if (is_cloth && reads) {
      reads = rest.starts_with('_');
      rest.remove_prefix(reads ? 1 : 0);
      reads = reads && take_number(rest, oy);
    }
    if (begins && reads && ox >= 0 && ox < plan_.count[0] && oy >= 0 && oy < plan_.count[1])
      return true;
    files_.wrong(element_, "must be in a body whose name starts with \"" + start +
                               "\", followed by its position in the " + plan_.type +
                               (is_cloth ? ", such as B0_0" : ", such as B0"));
    return false;
  }

  void add_rope(int body) {
    int ox = 0, oy = 0;
    if (!read_origin(body, ox, oy)) return;
    rope_geom(body, ox);
    int link = body;
    for (int ix = ox; ix < plan_.count[0] - 1; ++ix) link = rope_link(link, ix, ix + 1);
    link = body;
    for (int ix = ox; ix > 0; --ix) link = rope_link(link, ix, ix - 1);
  }

  void rope_geom(int link, int ix) {
    const double s = std::sqrt(0.5);
    add_geom(link, named("G", ix), {rotation_matrix(0.0, s, 0.0, s), Vec3<double>::Zero()});
  }

  int rope_link(int parent, int from, int to) {
    const double dx = plan_.spacing * (to - from);
    Affine<double> rest{Mat3<double>::Identity(), {dx, 0, 0}};
    if (plan_.type == "loop") {
      const double alpha = 2 * std::numbers::pi / plan_.count[0];
      const double radius =
          0.5 * plan_.spacing * std::sin(std::numbers::pi - alpha) / std::sin(0.5 * alpha);
      const double side = to > from ? 1 : -1, half = 0.5 * alpha;
      rest = {rotation_about({0, 0, 1}, side * alpha),
              {side * radius * std::cos(half), radius * std::sin(half), 0}};
    }
    const int link = add_link(parent, named("B", to), rest);
    rope_geom(link, to);
    const Vec3<double> anchor(-0.5 * dx, 0, 0);
    for (int i = 0; i < 2; ++i)
      add_joint(link, plan_.prefix + "J" + std::to_string(i) + "_" + std::to_string(to),
                JointKind::hinge, Vec3<double>::Unit(i + 1), anchor);
    add_extra(link, to, -1, Vec3<double>::UnitX(), anchor);
    return link;
  }

  void add_extra(int link, int ix, int iy, const Vec3<double>& axis, const Vec3<double>& anchor) {
    if (plan_.twists) add_joint(link, named("JT", ix, iy), JointKind::hinge, axis, anchor);
    if (plan_.stretches) add_joint(link, named("JS", ix, iy), JointKind::slide, axis, anchor);
  }

  void add_cloth(int body) {
    int ox = 0, oy = 0;
    if (!read_origin(body, ox, oy)) return;
    cloth_geom(body, ox, oy);
    add_column(body, ox, oy);
    for (const int step : {1, -1}) {
      int row = body;
      for (int ix = ox; ix + step >= 0 && ix + step < plan_.count[0]; ix += step) {
        row = cloth_link(row, ix, oy, ix + step, oy);
        add_column(row, ix + step, oy);
      }
    }
  }

  void add_column(int link, int ix, int oy) {
    for (const int step : {1, -1}) {
      int column = link;
      for (int iy = oy; iy + step >= 0 && iy + step < plan_.count[1]; iy += step)
        column = cloth_link(column, ix, iy, ix, iy + step);
    }
  }

  void cloth_geom(int link, int ix, int iy) {
    const double s = std::sqrt(0.5);
    const Mat3<double> turn =
        (ix + iy) % 2 != 0 ? rotation_matrix(s, 0.0, 0.0, s) : rotation_matrix(0.5, 0.5, 0.5, 0.5);
    add_geom(link, named("G", ix, iy), {turn, Vec3<double>::Zero()});
  }

  int cloth_link(int parent, int ix, int iy, int to_x, int to_y) {
    const Vec3<double> step = plan_.spacing * Vec3<double>(to_x - ix, to_y - iy, 0);
    const int link = add_link(parent, named("B", to_x, to_y), {Mat3<double>::Identity(), step});
    cloth_geom(link, to_x, to_y);
    const bool along_x = ix != to_x;
    for (int i = 0; i < 2; ++i)
      add_joint(link, named(i == 0 ? "J0_" : "J1_", to_x, to_y), JointKind::hinge,
                Vec3<double>::Unit(along_x ? i + 1 : 2 * i), -step);
    add_extra(link, to_x, to_y, Vec3<double>::Unit(along_x ? 0 : 1), -step);
    return link;
  }

  /// Maps the cube with corners at +-1 to the surface of the shape.
  Vec3<double> projected(Vec3<double> at) const {
    const Vec3<double> half =
        0.5 * plan_.spacing *
        Vec3<double>(plan_.count[0] - 1, plan_.count[1] - 1, plan_.count[2] - 1);
    if (plan_.type == "cylinder") {
      const double level = std::max(std::abs(at.x()), std::abs(at.y()));
      const double length = std::hypot(at.x(), at.y());
      // MuJoCo's normal of what has no direction is x.
      const double x = length < 1e-15 ? 1 : at.x() / length;
      const double y = length < 1e-15 ? 0 : at.y() / length;
      at = {x * level, y * level, at.z()};
    } else if (plan_.type == "ellipsoid") {
      at = unit(at);
    }
    return at.cwiseProduct(half);
  }

  void add_shell(int body) {
    ModelGeom outer = plan_.geom;
    plan_.geom.kind = "sphere";
    plan_.geom.shape = sphere_of(2 * plan_.size[0]);
    add_geom(body, plan_.prefix + "Gcenter", {});
    plan_.geom = outer;
    const double inwards =
        plan_.geom.kind == "capsule" ? plan_.size[0] + plan_.size[1] : plan_.size[0];
    const auto is_end = [&](int i, int axis) {
      return i == 0 || i == plan_.count[static_cast<std::size_t>(axis)] - 1;
    };
    for (int ix = 0; ix < plan_.count[0]; ++ix)
      for (int iy = 0; iy < plan_.count[1]; ++iy)
        for (int iz = 0; iz < plan_.count[2]; ++iz) {
          if (!is_end(ix, 0) && !is_end(iy, 1) && !is_end(iz, 2)) continue;
          const Vec3<double> at =
              projected({2.0 * ix / (plan_.count[0] - 1) - 1, 2.0 * iy / (plan_.count[1] - 1) - 1,
                         2.0 * iz / (plan_.count[2] - 1) - 1});
          const int link = add_link(body, named("B", ix, iy, iz), {rotation_of_z_to(at), at});
          add_geom(link, named("G", ix, iy, iz), {Mat3<double>::Identity(), {0, 0, -inwards}});
          add_joint(link, named("J", ix, iy, iz), JointKind::slide, {0, 0, 1},
                    Vec3<double>::Zero());
        }
  }

  Model& model_;
  CompositePlan plan_;
  const XmlElement& element_;
  XmlFiles& files_;
};

}  // namespace

void add_composite(Model& model, int body, const XmlElement& composite, XmlFiles& files,
                   const std::function<std::array<double, 4>(const XmlElement&)>& colour_of) {
  std::optional<CompositePlan> plan = read_composite(composite, files, colour_of);
  if (!plan) return;
  const double elements = static_cast<double>(model.geoms.size()) + plan->elements();
  if (elements > most_composite_elements)
    files.wrong(composite,
                "count: must be at most 100,000 elements, together with all geoms before it");
  else
    Composite(model, std::move(*plan), composite, files).add(body);
}

}  // namespace minkray
