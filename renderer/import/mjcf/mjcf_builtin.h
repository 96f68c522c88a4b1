// SPDX-License-Identifier: MIT
// MuJoCo's builtin meshes (3.3.5): the vertices of <mesh builtin="sphere" params="2"/>.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/math/vec.h"

namespace minkray {

/// Rounded to float, as in MuJoCo. Throws std::runtime_error that names the mistake in the name or
/// the parameters.
std::vector<Vec3<double>> builtin_mesh(const std::string& name, std::span<const double> params);

}  // namespace minkray
