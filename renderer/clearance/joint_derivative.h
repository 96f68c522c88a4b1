// SPDX-License-Identifier: MIT
// Derivatives by joint values from derivatives by the links' twists: the chain rule along the
// joints between link and base.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/pair_derivative/pair_derivative.h"
#include "renderer/import/model/model.h"

namespace minkray {

/// Derivative with respect to a twist of a link's frame about its origin; -1: the world, which does
/// not move.
struct LinkDerivative {
  int link = -1;
  TwistDerivative by;
  TwistError error = {};
};

/// Names of joints, and how many numbers each has.
using JointWidths = std::vector<std::pair<std::string, std::size_t>>;

/// The sum of the links' derivatives by each number of the joints, in their order. A joint that
/// mimics another adds to that one's. The numbers of quaternions are those that were given, of any
/// length: along the quaternion the derivative is zero.
std::vector<double> derivative_by_joints(const Model& posed, const JointWidths& joints,
                                         std::span<const LinkDerivative> links);

/// Bounds of the errors of derivative_by_joints: of the links' derivatives, and of rounding.
/// `rounding` is rounding_of_links(posed).
std::vector<double> errors_by_joints(const Model& posed, const JointWidths& joints,
                                     std::span<const LinkDerivative> links, const Drift& rounding);

/// Bounds by how much rounding may move and turn the model's links.
Drift rounding_of_links(const Model& posed);

}  // namespace minkray
