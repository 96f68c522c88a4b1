// SPDX-License-Identifier: MIT
// MJCF before its bodies are read: inserts included files and collects classes of defaults.
#pragma once

#include <map>

#include "renderer/import/model/xml.h"

namespace minkray {

/// Replaces each <include> by the contents of the other file. Files are searched next to the
/// root's own one, then next to the one that includes them; none may be included twice, as in
/// MuJoCo.
void expand_includes(XmlElement& root, XmlFiles& files);

class MjcfDefaults {
 public:
  /// Reads a <default>, and those in it.
  void read(const XmlElement& element, XmlFiles& files, const std::string& parent);

  /// The element with the attributes that its class (or else that of the bodies around it) gives
  /// it; of "size", which may be given in part, the numbers that are missing.
  XmlElement with_defaults(const XmlElement& element, const std::string& child_class,
                           XmlFiles& files) const;

  bool has(const std::string& name) const { return name.empty() || classes_.contains(name); }

 private:
  /// The keys are elements' names.
  using Class = std::map<std::string, std::vector<XmlAttribute>>;

  /// Counts what is put into a class. False, and once a mistake, if it is too much.
  bool takes(std::size_t bytes, const XmlElement& element, XmlFiles& files);

  std::map<std::string, Class> classes_;
  std::size_t bytes_ = 0;  ///< that were put into classes
};

}  // namespace minkray
