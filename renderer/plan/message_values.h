// SPDX-License-Identifier: MIT
// Parts of ROS messages: vectors, quaternions, poses and durations, each as an object of ROS ({x,
// y, z}) or as a list ([x, y, z], as Robowflex writes them).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/math/affine.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// Reads x, y and z. Other keys are ignored, since objects of messages have many.
Vec3<double> read_message_vector(const Json& json, const JsonPath& path, Mistakes& mistakes);

/// Reads x, y, z, w. A quaternion of length zero is the identity, as in MoveIt.
std::array<double, 4> read_message_quaternion(const Json& json, const JsonPath& path,
                                              Mistakes& mistakes);

/// Reads a geometry_msgs/Pose or Transform: `position` or `translation`, and `orientation` or
/// `rotation`. Each may be missing.
Affine<double> read_message_pose(const Json& json, const JsonPath& path, Mistakes& mistakes);

/// Reads seconds, from {secs, nsecs}, {sec, nanosec} or a number.
std::optional<double> read_message_duration(const Json& json, const JsonPath& path,
                                            Mistakes& mistakes);

/// Reads a list of any length; null is an empty list.
std::vector<double> read_number_list(const Json& json, const JsonPath& path, Mistakes& mistakes);
std::vector<std::string> read_name_list(const Json& json, const JsonPath& path, Mistakes& mistakes);

/// Returns the value of a key of an object; null if it is missing or null.
const Json* member_of(const Json& json, std::string_view key);

/// Returns the items of the list `key`; none if it is missing or null. Anything else is a mistake.
const Json& list_of(const Json& json, std::string_view key, const JsonPath& path,
                    Mistakes& mistakes);

/// Returns the text of a key; empty if it is missing.
std::string text_of(const Json& json, std::string_view key, const JsonPath& path,
                    Mistakes& mistakes);

}  // namespace minkray
