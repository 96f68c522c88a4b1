// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf_composite.h"

#include <cmath>
#include <cstdio>
#include <numbers>

#include "renderer/import/geometry_common.h"
#include "renderer/import/orientation.h"

namespace minkray {
namespace {

/// Beyond that nobody means it.
constexpr double most_elements = 1e6;

class Composite {
 public:
  Composite(Model& model, const XmlElement& element, XmlFiles& files)
      : model_(model), element_(element), files_(files) {}

  void add(int body, const std::function<std::array<double, 4>(const XmlElement&)>& colour_of) {
    if (!read(colour_of)) return;
    if (type_ == "particle")
      add_particles(body);
    else if (type_ == "grid")
      add_grid(body);
    else if (type_ == "rope" || type_ == "loop")
      add_rope(body);
    else if (type_ == "cloth")
      add_cloth(body);
    else
      add_shell(body);
  }

 private:
  bool read(const std::function<std::array<double, 4>(const XmlElement&)>& colour_of) {
    type_ = element_.attribute_or("type");
    static const std::set<std::string> known = {"particle", "grid", "rope",     "loop",
                                                "cloth",    "box",  "cylinder", "ellipsoid"};
    if (!known.contains(type_)) {
      files_.wrong(element_,
                   "type: must be one of particle, grid, rope, loop, cloth, box, "
                   "cylinder and ellipsoid (got \"" +
                       printable(type_, 40) + "\")");
      return false;
    }
    prefix_ = element_.attribute_or("prefix");
    const auto counts = files_.numbers(element_, "count", 1, 3);
    const auto spacing = files_.number(element_, "spacing");
    if (!counts || !spacing) {
      files_.wrong(element_, "count and spacing: must be there");
      return false;
    }
    spacing_ = *spacing;
    double product = 1;
    int dimensions = 0;
    bool is_ordered = true;
    for (std::size_t i = 0; i < counts->size(); ++i) {
      const double count = (*counts)[i];
      if (!(count >= 1 && count <= most_elements) || count != std::floor(count)) {
        files_.wrong(element_, "count: must be whole numbers from 1 on");
        return false;
      }
      if (count > 1 && dimensions < static_cast<int>(i)) is_ordered = false;
      dimensions += count > 1 ? 1 : 0;
      count_[i] = static_cast<int>(count);
      product *= count;
    }
    if (!is_ordered || product > most_elements || !(spacing_ > 0)) {
      files_.wrong(element_, !is_ordered               ? "count: ones must come last"
                             : product > most_elements ? "count: at most a million elements"
                                                       : "spacing: must be > 0");
      return false;
    }
    const int expected = type_ == "rope" || type_ == "loop" ? 1 : type_ == "cloth" ? 2 : 3;
    const bool is_shell = type_ == "box" || type_ == "cylinder" || type_ == "ellipsoid";
    if ((type_ == "grid" && dimensions > 2) ||
        ((expected < 3 || is_shell) && dimensions != expected)) {
      files_.wrong(element_, "count: does not fit a " + type_);
      return false;
    }
    if (const auto offset = files_.vector(element_, "offset")) offset_ = *offset;
    for (const XmlElement& child : element_.children) {
      if (child.name == "pin") {
        const auto at = files_.numbers(child, "coord", 1, 2);
        if (at)
          pins_.insert(
              {static_cast<int>((*at)[0]), at->size() > 1 ? static_cast<int>((*at)[1]) : 0});
      }
      if (child.name == "joint") {
        twists_ |= child.attribute_or("kind") == "twist";
        stretches_ |= child.attribute_or("kind") == "stretch";
      }
    }
    return read_geom(colour_of);
  }

  bool read_geom(const std::function<std::array<double, 4>(const XmlElement&)>& colour_of) {
    const XmlElement* geom = element_.child("geom");
    if (!geom) {
      files_.wrong(element_, "geom: must be there");
      return false;
    }
    kind_ = geom->attribute_or("type", "sphere");
    if (type_ == "particle" || type_ == "grid") kind_ = "sphere";
    const bool is_shell = type_ == "box" || type_ == "cylinder" || type_ == "ellipsoid";
    if (is_shell && kind_ != "capsule") kind_ = "sphere";
    const std::size_t sizes = kind_ == "sphere" ? 1 : kind_ == "capsule" ? 2 : 3;
    if (kind_ != "sphere" && kind_ != "capsule" && kind_ != "ellipsoid") {
      files_.wrong(*geom, "type: must be sphere, capsule or ellipsoid");
      return false;
    }
    const auto size = files_.numbers(*geom, "size", sizes, 3);
    bool is_good = size.has_value();
    for (std::size_t i = 0; is_good && i < sizes; ++i) is_good = (*size)[i] > 0;
    if (!is_good) {
      files_.wrong(*geom, "size: must be " + std::to_string(sizes) + " numbers > 0");
      return false;
    }
    size_ = *size;
    model_geom_.kind = kind_;
    model_geom_.rgba = colour_of(*geom);
    // Where there is a skin, the shapes are what it hides.
    const bool hides = element_.child("skin") && type_ != "particle" && type_ != "rope" &&
                       type_ != "loop" && !(type_ == "grid" && count_[1] == 1);
    const auto group = files_.number(*geom, "group");
    model_geom_.is_seen = group.value_or(hides ? 3 : 0) < 3;
    // A skin itself is no convex shape: what it covers is shown in its place.
    if (hides && !group) model_geom_.is_seen = true;
    if (hides) model_.pass_over("<composite><skin>", "is no convex shape");
    const auto flag = [&](const char* key, double otherwise) {
      return files_.number(*geom, key).value_or(otherwise) != 0;
    };
    model_geom_.collides = flag("contype", is_shell ? 0 : 1) || flag("conaffinity", 1);
    model_geom_.shape = kind_ == "sphere"    ? sphere_of(size_[0])
                        : kind_ == "capsule" ? capsule_of(size_[0], size_[1])
                                             : ellipsoid_of({size_[0], size_[1], size_[2]});
    return true;
  }

  int add_link(int parent, const std::string& name, const Affine<double>& rest) {
    model_.links.push_back({name, parent, rest});
    return static_cast<int>(model_.links.size()) - 1;
  }

  void add_geom(int link, const std::string& name, const Affine<double>& pose) {
    model_geom_.link = link;
    model_geom_.name = name;
    model_geom_.pose = pose;
    model_.geoms.push_back(model_geom_);
  }

  ModelJoint& add_joint(int link, const std::string& name, JointKind kind, const Vec3<double>& axis,
                        const Vec3<double>& anchor) {
    std::vector<ModelJoint>& joints = model_.links[static_cast<std::size_t>(link)].joints;
    joints.push_back({name, kind, axis, anchor});
    return joints.back();
  }

  std::string named(const char* letter, int ix, int iy = -1, int iz = -1) const {
    std::string name = prefix_ + letter + std::to_string(ix);
    if (iy >= 0) name += "_" + std::to_string(iy);
    if (iz >= 0) name += "_" + std::to_string(iz);
    return name;
  }

  void add_slides(int link, const std::string& suffix) {
    for (int i = 0; i < 3; ++i)
      add_joint(link, suffix.empty() ? "" : prefix_ + "J" + std::to_string(i) + suffix,
                JointKind::slide, Vec3<double>::Unit(i), Vec3<double>::Zero());
  }

  void add_particles(int body) {
    for (int ix = 0; ix < count_[0]; ++ix)
      for (int iy = 0; iy < count_[1]; ++iy)
        for (int iz = 0; iz < count_[2]; ++iz) {
          const Vec3<double> half(0.5 * count_[0], 0.5 * count_[1], 0.5 * count_[2]);
          const Vec3<double> at = offset_ + spacing_ * (Vec3<double>(ix, iy, iz) - half);
          const int link = add_link(body, "", {Mat3<double>::Identity(), at});
          add_slides(link, "");
          add_geom(link, "", {});
        }
  }

  void add_grid(int body) {
    for (int ix = 0; ix < count_[0]; ++ix)
      for (int iy = 0; iy < count_[1]; ++iy) {
        const Vec3<double> at =
            offset_ + spacing_ * Vec3<double>(ix - 0.5 * count_[0], iy - 0.5 * count_[1], 0);
        const int link = add_link(body, named("B", ix, iy), {Mat3<double>::Identity(), at});
        add_geom(link, named("G", ix, iy), {});
        if (!pins_.contains({ix, iy}))
          add_slides(link, "_" + std::to_string(ix) + "_" + std::to_string(iy));
      }
  }

  /// Whether the body around it has the name that begins a rope or cloth: "B3" or "B3_5".
  bool read_origin(int body, int& ox, int& oy) {
    const std::string name = body < 0 ? "" : model_.links[static_cast<std::size_t>(body)].name;
    const bool is_cloth = type_ == "cloth";
    const std::string start = prefix_ + "B";
    oy = 0;
    const bool begins = name.starts_with(start);
    const char* rest = begins ? name.c_str() + start.size() : "";
    const bool reads =
        is_cloth ? std::sscanf(rest, "%d_%d", &ox, &oy) == 2 : std::sscanf(rest, "%d", &ox) == 1;
    if (begins && reads && ox >= 0 && ox < count_[0] && oy >= 0 && oy < count_[1]) return true;
    files_.wrong(element_, "must be in a body whose name begins with \"" + start +
                               "\" and goes on with its place in the " + type_ +
                               (is_cloth ? ", such as B0_0" : ", such as B0"));
    return false;
  }

  void add_rope(int body) {
    int ox = 0, oy = 0;
    if (!read_origin(body, ox, oy)) return;
    rope_geom(body, ox);
    int link = body;
    for (int ix = ox; ix < count_[0] - 1; ++ix) link = rope_link(link, ix, ix + 1);
    link = body;
    for (int ix = ox; ix > 0; --ix) link = rope_link(link, ix, ix - 1);
  }

  void rope_geom(int link, int ix) {
    const double s = std::sqrt(0.5);
    add_geom(link, named("G", ix), {rotation_matrix(0.0, s, 0.0, s), Vec3<double>::Zero()});
  }

  int rope_link(int parent, int from, int to) {
    const double dx = spacing_ * (to - from);
    Affine<double> rest{Mat3<double>::Identity(), {dx, 0, 0}};
    if (type_ == "loop") {
      const double alpha = 2 * std::numbers::pi / count_[0];
      const double radius =
          0.5 * spacing_ * std::sin(std::numbers::pi - alpha) / std::sin(0.5 * alpha);
      const double side = to > from ? 1 : -1, half = 0.5 * alpha;
      rest = {rotation_about({0, 0, 1}, side * alpha),
              {side * radius * std::cos(half), radius * std::sin(half), 0}};
    }
    const int link = add_link(parent, named("B", to), rest);
    rope_geom(link, to);
    const Vec3<double> anchor(-0.5 * dx, 0, 0);
    for (int i = 0; i < 2; ++i)
      add_joint(link, prefix_ + "J" + std::to_string(i) + "_" + std::to_string(to),
                JointKind::hinge, Vec3<double>::Unit(i + 1), anchor);
    add_extra(link, "", to, -1, Vec3<double>::UnitX(), anchor);
    return link;
  }

  void add_extra(int link, const std::string&, int ix, int iy, const Vec3<double>& axis,
                 const Vec3<double>& anchor) {
    if (twists_) add_joint(link, named("JT", ix, iy), JointKind::hinge, axis, anchor);
    if (stretches_) add_joint(link, named("JS", ix, iy), JointKind::slide, axis, anchor);
  }

  void add_cloth(int body) {
    int ox = 0, oy = 0;
    if (!read_origin(body, ox, oy)) return;
    cloth_geom(body, ox, oy);
    add_column(body, ox, oy);
    for (const int step : {1, -1}) {
      int row = body;
      for (int ix = ox; ix + step >= 0 && ix + step < count_[0]; ix += step) {
        row = cloth_link(row, ix, oy, ix + step, oy);
        add_column(row, ix + step, oy);
      }
    }
  }

  void add_column(int link, int ix, int oy) {
    for (const int step : {1, -1}) {
      int column = link;
      for (int iy = oy; iy + step >= 0 && iy + step < count_[1]; iy += step)
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
    const Vec3<double> step = spacing_ * Vec3<double>(to_x - ix, to_y - iy, 0);
    const int link = add_link(parent, named("B", to_x, to_y), {Mat3<double>::Identity(), step});
    cloth_geom(link, to_x, to_y);
    const bool along_x = ix != to_x;
    for (int i = 0; i < 2; ++i)
      add_joint(link, named(i == 0 ? "J0_" : "J1_", to_x, to_y), JointKind::hinge,
                Vec3<double>::Unit(along_x ? i + 1 : 2 * i), -step);
    add_extra(link, "", to_x, to_y, Vec3<double>::Unit(along_x ? 0 : 1), -step);
    return link;
  }

  /// Maps the cube with corners at +-1 to the surface of the shape.
  Vec3<double> projected(Vec3<double> at) const {
    const Vec3<double> half =
        0.5 * spacing_ * Vec3<double>(count_[0] - 1, count_[1] - 1, count_[2] - 1);
    if (type_ == "cylinder") {
      const double level = std::max(std::abs(at.x()), std::abs(at.y()));
      const double length = std::hypot(at.x(), at.y());
      // MuJoCo's normal of what has no direction is x.
      const double x = length < 1e-15 ? 1 : at.x() / length;
      const double y = length < 1e-15 ? 0 : at.y() / length;
      at = {x * level, y * level, at.z()};
    } else if (type_ == "ellipsoid") {
      at = unit(at);
    }
    return at.cwiseProduct(half);
  }

  void add_shell(int body) {
    ModelGeom outer = model_geom_;
    model_geom_.kind = "sphere";
    model_geom_.shape = sphere_of(2 * size_[0]);
    add_geom(body, prefix_ + "Gcenter", {});
    model_geom_ = outer;
    const double inwards = kind_ == "capsule" ? size_[0] + size_[1] : size_[0];
    const auto is_end = [&](int i, int axis) {
      return i == 0 || i == count_[static_cast<std::size_t>(axis)] - 1;
    };
    for (int ix = 0; ix < count_[0]; ++ix)
      for (int iy = 0; iy < count_[1]; ++iy)
        for (int iz = 0; iz < count_[2]; ++iz) {
          if (!is_end(ix, 0) && !is_end(iy, 1) && !is_end(iz, 2)) continue;
          const Vec3<double> at =
              projected({2.0 * ix / (count_[0] - 1) - 1, 2.0 * iy / (count_[1] - 1) - 1,
                         2.0 * iz / (count_[2] - 1) - 1});
          const int link = add_link(body, named("B", ix, iy, iz), {rotation_of_z_to(at), at});
          add_geom(link, named("G", ix, iy, iz), {Mat3<double>::Identity(), {0, 0, -inwards}});
          add_joint(link, named("J", ix, iy, iz), JointKind::slide, {0, 0, 1},
                    Vec3<double>::Zero());
        }
  }

  Model& model_;
  const XmlElement& element_;
  XmlFiles& files_;
  std::string type_, prefix_, kind_;
  std::array<int, 3> count_ = {1, 1, 1};
  double spacing_ = 0;
  Vec3<double> offset_ = Vec3<double>::Zero();
  std::set<std::pair<int, int>> pins_;
  bool twists_ = false, stretches_ = false;
  std::vector<double> size_;
  ModelGeom model_geom_;
};

}  // namespace

void add_composite(Model& model, int body, const XmlElement& composite, XmlFiles& files,
                   const std::function<std::array<double, 4>(const XmlElement&)>& colour_of) {
  Composite(model, composite, files).add(body, colour_of);
}

}  // namespace minkray
