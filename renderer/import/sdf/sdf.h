// SPDX-License-Identifier: MIT
// SDF (http://sdformat.org/spec): worlds and models, nested and included, with poses relative to
// frames, links and joints.
#pragma once

#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/import/model/xml.h"

namespace minkray {

Model read_sdf(XmlElement root, XmlFiles& files, const ImportOptions& options);

}  // namespace minkray
