// SPDX-License-Identifier: MIT
// Poses in SDF: each is given relative to a link, a frame or a joint of its model, and these may be
// relative to others in turn.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/math/affine.h"
#include "renderer/import/xml.h"

namespace minkray {

/// The pose that an element's <pose> says; the identity without one.
Affine<double> sdf_pose(const XmlElement& element, XmlFiles& files);

/// The text of a child, without the blanks around it; "" if there is no such child.
std::string sdf_text(const XmlElement& element, std::string_view key);

/// A <model>'s names, each with its pose in the model's frame.
class SdfFrames {
 public:
  /// Collects the names of links, frames, joints and nested models before any pose is asked for:
  /// poses may be relative to what stands further down.
  SdfFrames(const XmlElement& model, XmlFiles& files);

  /// The pose of a name in the model's frame; `asks` is the element that a mistake names.
  Affine<double> pose_of(const std::string& name, const XmlElement& asks);

 private:
  /// A frame whose pose is given in another one.
  struct Frame {
    Affine<double> pose;
    std::string relative_to;
    const XmlElement* element;
    bool is_known = false;
    bool is_open = false;  ///< it is being looked for: to find it again is a circle
    Affine<double> in_model = {};
  };

  void find(Frame& frame);

  XmlFiles& files_;
  std::map<std::string, Frame> frames_;
};

}  // namespace minkray
