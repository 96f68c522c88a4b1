// SPDX-License-Identifier: MIT
// Poses in SDF, each relative to a link, frame, joint or nested model, which may be relative to
// others. "arm::hand" is the hand of the nested model arm.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "core/math/affine.h"
#include "renderer/import/model/xml.h"

namespace minkray {

/// The pose in an element's <pose>; the identity without one.
Affine<double> sdf_pose(const XmlElement& element, XmlFiles& files);

/// The text of an element, without the blanks around it.
std::string sdf_text(const XmlElement& element);

/// The text of a child, without the blanks around it; "" if there is no such child.
std::string sdf_text(const XmlElement& element, std::string_view key);

/// The names of a <model> or a <world>, each with its pose in its frame.
class SdfFrames {
 public:
  /// Collects the names of links, frames, joints and nested models before any pose is computed:
  /// poses may be relative to elements further down.
  SdfFrames(const XmlElement& model, XmlFiles& files);

  /// The pose of a name in the model's frame; `asks` is the element that a mistake names.
  Affine<double> pose_of(const std::string& name, const XmlElement& asks);

  /// The pose in an element's <pose>, in the model's frame; relative to `otherwise` if the element
  /// names no frame.
  Affine<double> pose_in_model(const XmlElement& element, const std::string& otherwise = "");

  /// True if an element's <pose> names a frame.
  bool is_relative(const XmlElement& element) const;

  /// The link that a link, a frame or a joint is fixed to; the name itself if it is none of these.
  std::string link_of(const std::string& name) const;

 private:
  /// A frame whose pose is given in another one.
  struct Frame {
    Affine<double> pose;
    std::string relative_to;
    const XmlElement* element;
    bool is_known = false;
    bool is_open = false;  ///< in progress: finding it again is a circle
    Affine<double> in_model = {};
  };

  void find(Frame& frame);
  SdfFrames& inner_of(const XmlElement& model);

  const XmlElement& model_;
  XmlFiles& files_;
  std::map<std::string, Frame> frames_;
  std::map<const XmlElement*, std::unique_ptr<SdfFrames>> inner_;  ///< resolved nested models
};

}  // namespace minkray
