// SPDX-License-Identifier: MIT
// MJCF's <compiler>: the units of angles, the order of Euler angles, folders of meshes; and the
// poses that depend on it.
#pragma once

#include <string>

#include "core/math/affine.h"
#include "renderer/import/model/xml.h"

namespace minkray {

class MjcfCompiler {
 public:
  explicit MjcfCompiler(XmlFiles& files) : files_(files) {}

  /// Reads a <compiler>; later ones add to it.
  void read(const XmlElement& e);

  bool is_global() const { return is_global_; }
  bool auto_limits() const { return auto_limits_; }
  bool discards_visual() const { return discards_visual_; }
  bool strips_path() const { return strips_path_; }
  bool fits_box() const { return fits_box_; }
  const std::string& mesh_folder() const { return mesh_folder_; }

  /// An angle of the file in radians.
  double angle(double given) const;

  /// The turn by three angles of the file.
  Mat3<double> turn_of(const Vec3<double>& angles) const;

  /// The pose in an element's attributes.
  Affine<double> pose_in(const XmlElement& e) const;

 private:
  bool flag(const XmlElement& element, std::string_view key, bool otherwise) const;
  Vec3<double> direction(const XmlElement& element, std::string_view key,
                         const std::vector<double>& v, std::size_t first) const;
  Mat3<double> rotation_in(const XmlElement& e) const;

  XmlFiles& files_;
  bool is_degree_ = true, is_global_ = false, auto_limits_ = false, discards_visual_ = false;
  bool strips_path_ = false, fits_box_ = false;
  std::string mesh_folder_, euler_ = "xyz";
};

}  // namespace minkray
