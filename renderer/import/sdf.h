// SPDX-License-Identifier: MIT
// SDF (http://sdformat.org/spec): worlds and models, nested and included, with poses relative to
// frames, links and joints.
#pragma once

#include "renderer/import/import_options.h"
#include "renderer/import/model.h"
#include "renderer/import/xml.h"

namespace minkray {

Model read_sdf(XmlElement root, XmlFiles& files, const ImportOptions& options);

}  // namespace minkray
