// SPDX-License-Identifier: MIT
// What a robot's file holds, and what of it is not in the scene.
#pragma once

#include <string>

#include "renderer/import/model.h"

namespace minkray {

std::string model_as_text(const Model& model);

}  // namespace minkray
