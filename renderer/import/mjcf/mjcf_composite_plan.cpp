// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf/mjcf_composite_plan.h"

#include <cmath>

#include "renderer/import/mesh/geometry_common.h"

namespace minkray {
namespace {

class PlanReader {
 public:
  PlanReader(const XmlElement& element, XmlFiles& files) : element_(element), files_(files) {}

  /// True if everything is valid.
  bool read(const std::function<std::array<double, 4>(const XmlElement&)>& colour_of) {
    if (!read_type() || !read_counts()) return false;
    if (const auto offset = files_.vector(element_, "offset")) plan_.offset = *offset;
    for (const XmlElement& child : element_.children) {
      if (child.name == "pin" && !read_pin(child)) return false;
      if (child.name == "joint") {
        plan_.twists |= child.attribute_or("kind") == "twist";
        plan_.stretches |= child.attribute_or("kind") == "stretch";
      }
    }
    return read_geom(colour_of);
  }

  CompositePlan take() { return std::move(plan_); }

 private:
  bool wrong(const XmlElement& element, const std::string& message) {
    files_.wrong(element, message);
    return false;
  }

  bool read_type() {
    plan_.type = element_.attribute_or("type");
    static const std::set<std::string> known = {"particle", "grid", "rope",     "loop",
                                                "cloth",    "box",  "cylinder", "ellipsoid"};
    if (!known.contains(plan_.type))
      return wrong(element_,
                   "type: must be one of particle, grid, rope, loop, cloth, box, "
                   "cylinder and ellipsoid (got \"" +
                       printable(plan_.type, 40) + "\")");
    plan_.prefix = element_.attribute_or("prefix");
    return true;
  }

  bool read_pin(const XmlElement& pin) {
    const auto at = files_.numbers(pin, "coord", 1, 2);
    if (!at) return pin.attribute("coord") ? false : wrong(pin, "coord: missing");
    for (const double place : *at)
      if (!(place >= 0 && place <= most_composite_elements) || place != std::floor(place))
        return wrong(pin, "coord: must be whole numbers from 0 to 100,000 (got \"" +
                              printable(pin.attribute_or("coord"), 60) + "\")");
    plan_.pins.insert(
        {static_cast<int>((*at)[0]), at->size() > 1 ? static_cast<int>((*at)[1]) : 0});
    return true;
  }

  bool read_counts() {
    const auto counts = files_.numbers(element_, "count", 1, 3);
    const auto spacing = files_.number(element_, "spacing");
    if (!counts || !spacing) return wrong(element_, "count and spacing: missing");
    plan_.spacing = *spacing;
    double product = 1;
    int dimensions = 0;
    bool is_ordered = true;
    for (std::size_t i = 0; i < counts->size(); ++i) {
      const double count = (*counts)[i];
      if (!(count >= 1 && count <= most_composite_elements) || count != std::floor(count))
        return wrong(element_, "count: must be whole numbers >= 1");
      if (count > 1 && dimensions < static_cast<int>(i)) is_ordered = false;
      dimensions += count > 1 ? 1 : 0;
      plan_.count[i] = static_cast<int>(count);
      product *= count;
    }
    if (!is_ordered) return wrong(element_, "count: values of 1 must come last");
    if (product > most_composite_elements)
      return wrong(element_, "count: at most 100,000 elements");
    if (!(plan_.spacing > 0)) return wrong(element_, "spacing: must be > 0");
    const std::string& type = plan_.type;
    const int expected = type == "rope" || type == "loop" ? 1 : type == "cloth" ? 2 : 3;
    if ((type == "grid" && dimensions > 2) ||
        ((expected < 3 || plan_.is_shell()) && dimensions != expected))
      return wrong(element_, "count: does not fit a " + type);
    return true;
  }

  bool read_geom(const std::function<std::array<double, 4>(const XmlElement&)>& colour_of) {
    const XmlElement* geom = element_.child("geom");
    if (!geom) return wrong(element_, "geom: missing");
    const std::string& type = plan_.type;
    std::string kind = geom->attribute_or("type", "sphere");
    if (type == "particle" || type == "grid") kind = "sphere";
    if (plan_.is_shell() && kind != "capsule") kind = "sphere";
    const std::size_t sizes = kind == "sphere" ? 1 : kind == "capsule" ? 2 : 3;
    if (kind != "sphere" && kind != "capsule" && kind != "ellipsoid")
      return wrong(*geom, "type: must be sphere, capsule or ellipsoid");
    const auto size = files_.numbers(*geom, "size", sizes, 3);
    bool is_good = size.has_value();
    for (std::size_t i = 0; is_good && i < sizes; ++i) is_good = (*size)[i] > 0;
    if (!is_good) return wrong(*geom, "size: must be " + counted_numbers(sizes) + " > 0");
    plan_.size = *size;
    plan_.geom.kind = kind;
    plan_.geom.rgba = colour_of(*geom);
    // With a skin, the shapes are those it hides.
    plan_.hides_skin = element_.child("skin") && type != "particle" && type != "rope" &&
                       type != "loop" && !(type == "grid" && plan_.count[1] == 1);
    // A skin itself not a convex shape: what it covers is shown in its place.
    plan_.geom.is_seen = files_.number(*geom, "group").value_or(0) < 3;
    const auto flag = [&](const char* key, double otherwise) {
      return files_.number(*geom, key).value_or(otherwise) != 0;
    };
    plan_.geom.collides = flag("contype", plan_.is_shell() ? 0 : 1) || flag("conaffinity", 1);
    plan_.geom.shape = kind == "sphere" ? sphere_of(plan_.size[0])
                       : kind == "capsule"
                           ? capsule_of(plan_.size[0], plan_.size[1])
                           : ellipsoid_of({plan_.size[0], plan_.size[1], plan_.size[2]});
    return true;
  }

  const XmlElement& element_;
  XmlFiles& files_;
  CompositePlan plan_;
};

}  // namespace

std::optional<CompositePlan> read_composite(
    const XmlElement& element, XmlFiles& files,
    const std::function<std::array<double, 4>(const XmlElement&)>& colour_of) {
  PlanReader reader(element, files);
  if (!reader.read(colour_of)) return std::nullopt;
  return reader.take();
}

}  // namespace minkray
