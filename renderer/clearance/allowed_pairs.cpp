// SPDX-License-Identifier: MIT
#include "renderer/clearance/allowed_pairs.h"

#include <algorithm>

#include "renderer/import/model/xml.h"

namespace minkray {

void read_srdf(const std::string& file, const Model& model, AllowedPairs& allowed,
               Mistakes& mistakes) {
  XmlFiles files(mistakes);
  const auto root = files.read(file);
  if (!root) return;
  if (root->name != "robot") {
    files.wrong(*root, "must be <robot> (SRDF)");
    return;
  }
  const auto link = [&](const XmlElement& element, std::string_view key) -> std::string {
    const std::string name = element.attribute_or(key);
    if (find_link(model, name) < 0)
      files.wrong(element, std::string(key) + ": there is no link \"" + printable(name, 60) + "\"");
    return name;
  };
  // Exceptions come last, wherever they are.
  for (const XmlElement& element : root->children) {
    if (element.name == "disable_collisions") {
      allowed.allow(link(element, "link1"), link(element, "link2"));
    } else if (element.name == "disable_default_collisions") {
      const std::string name = link(element, "link");
      for (const ModelLink& other : model.links) allowed.allow(name, other.name);
    }
  }
  for (const XmlElement& element : root->children)
    if (element.name == "enable_collisions")
      allowed.forbid(link(element, "link1"), link(element, "link2"));
}

std::vector<int> rigid_groups(const Model& model) {
  std::vector<int> groups;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const ModelLink& link = model.links[i];
    const bool moves = std::ranges::any_of(
        link.joints, [](const ModelJoint& joint) { return joint.kind != JointKind::fixed; });
    groups.push_back(moves || link.parent < 0 ? static_cast<int>(i)
                                              : groups[static_cast<std::size_t>(link.parent)]);
  }
  return groups;
}

}  // namespace minkray
