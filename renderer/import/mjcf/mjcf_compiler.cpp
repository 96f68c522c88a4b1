// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf/mjcf_compiler.h"

#include <numbers>

#include "renderer/import/model/orientation.h"

namespace minkray {

bool MjcfCompiler::flag(const XmlElement& element, std::string_view key, bool otherwise) const {
  const std::string* text = element.attribute(key);
  if (!text) return otherwise;
  if (*text != "true" && *text != "false" && *text != "auto")
    files_.wrong(element, std::string(key) + ": must be true or false (got \"" +
                              printable(*text, 40) + "\")");
  return *text == "true";
}

void MjcfCompiler::read(const XmlElement& e) {
  if (const std::string* angle = e.attribute("angle")) {
    is_degree_ = *angle == "degree";
    if (*angle != "degree" && *angle != "radian")
      files_.wrong(e, "angle: must be degree or radian (got \"" + printable(*angle, 40) + "\")");
  }
  if (const std::string* coordinate = e.attribute("coordinate"))
    is_global_ = *coordinate == "global";
  if (const std::string* folder = e.attribute("assetdir")) mesh_folder_ = *folder;
  if (const std::string* folder = e.attribute("meshdir")) mesh_folder_ = *folder;
  if (const std::string* euler = e.attribute("eulerseq")) {
    if (euler->size() == 3 && euler->find_first_not_of("xyzXYZ") == euler->npos)
      euler_ = *euler;
    else
      files_.wrong(e, "eulerseq: must be three of x, y, z, X, Y, Z");
  }
  auto_limits_ = flag(e, "autolimits", auto_limits_);
  discards_visual_ = flag(e, "discardvisual", discards_visual_);
  strips_path_ = flag(e, "strippath", strips_path_);
  fits_box_ = flag(e, "fitaabb", fits_box_);
}

double MjcfCompiler::angle(double given) const {
  return is_degree_ ? given * (std::numbers::pi / 180) : given;
}

Vec3<double> MjcfCompiler::direction(const XmlElement& element, std::string_view key,
                                     const std::vector<double>& v, std::size_t first) const {
  const Vec3<double> d = unit<double>({v[first], v[first + 1], v[first + 2]});
  if (d.isZero(0)) files_.wrong(element, std::string(key) + ": must not be zero");
  return d.isZero(0) ? Vec3<double>(0, 0, 1) : d;
}

Mat3<double> MjcfCompiler::rotation_in(const XmlElement& e) const {
  if (const auto q = files_.numbers(e, "quat", 4, 4)) {
    if ((*q)[0] != 0 || (*q)[1] != 0 || (*q)[2] != 0 || (*q)[3] != 0)
      return rotation_matrix_of_any((*q)[1], (*q)[2], (*q)[3], (*q)[0]);
    files_.wrong(e, "quat: must not be zero");
  }
  if (const auto v = files_.numbers(e, "axisangle", 4, 4))
    return rotation_about(direction(e, "axisangle", *v, 0), angle((*v)[3]));
  if (const auto v = files_.numbers(e, "euler", 3, 3)) return turn_of({(*v)[0], (*v)[1], (*v)[2]});
  if (const auto v = files_.numbers(e, "xyaxes", 6, 6)) {
    const Vec3<double> x = direction(e, "xyaxes", *v, 0), y = direction(e, "xyaxes", *v, 3);
    if (x.cross(y).norm() > 1e-10) return rotation_of_xy(x, y);
    files_.wrong(e, "xyaxes: must not be parallel");
  }
  if (const auto v = files_.numbers(e, "zaxis", 3, 3))
    return rotation_of_z_to(direction(e, "zaxis", *v, 0));
  return Mat3<double>::Identity();
}

Mat3<double> MjcfCompiler::turn_of(const Vec3<double>& angles) const {
  return rotation_of_euler({angle(angles.x()), angle(angles.y()), angle(angles.z())}, euler_);
}

Affine<double> MjcfCompiler::pose_in(const XmlElement& e) const {
  return {rotation_in(e), files_.vector(e, "pos").value_or(Vec3<double>::Zero())};
}

}  // namespace minkray
