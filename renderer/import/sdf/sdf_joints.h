// SPDX-License-Identifier: MIT
// Joints of SDF. A model's links are a flat list in the file; the joints make trees of them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderer/import/model/model.h"
#include "renderer/import/sdf/sdf_frames.h"

namespace minkray {

/// A joint as the file has it.
struct SdfJoint {
  const XmlElement* element;
  std::string parent, child, name;
  SdfFrames* frames;  ///< of its model
  Affine<double> model_in_world;
  std::string prefix;     ///< of its model's names
  bool axis_is_in_model;  ///< so it was up to SDF 1.4
};

/// The links in the order of the file, their poses in the world.
struct SdfLinks {
  std::vector<const XmlElement*> elements;
  std::map<std::string, int> index;  ///< by name
};

/// Makes the model's links trees: each behind its parent, its pose relative to it.
void connect_links(Model& model, const SdfLinks& links, const std::vector<SdfJoint>& joints,
                   XmlFiles& files);

}  // namespace minkray
