// SPDX-License-Identifier: MIT
// Elements of MJCF that are newer than the supported version, each with MuJoCo's version that added
// it.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>

#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/import/model/xml.h"

namespace minkray {

struct NewerElement {
  std::string_view name, version;
};
inline constexpr NewerElement newer_elements[] = {
    {"flexcomp", "3.0"}, {"flex", "3.0"}, {"deformable", "3.0"}};

/// True if the element is one of these: a mistake, or passed over if that is allowed.
inline bool is_newer(const XmlElement& element, Model& model, XmlFiles& files,
                     const ImportOptions& options) {
  const auto newer = std::ranges::find(newer_elements, element.name, &NewerElement::name);
  if (newer == std::end(newer_elements)) return false;
  const std::string what =
      "is of MuJoCo " + std::string(newer->version) + ": deformable bodies are not supported";
  if (options.lenient)
    model.pass_over("<" + element.name + ">", what);
  else
    files.wrong(element, what + " (--lenient skips them)");
  return true;
}

}  // namespace minkray
