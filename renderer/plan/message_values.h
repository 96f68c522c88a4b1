// SPDX-License-Identifier: MIT
// Parts that ROS messages are made of: vectors, quaternions, poses and durations, each as an object
// of ROS ({x, y, z}) or as a list ([x, y, z], as Robowflex writes them).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/math/affine.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// Objects of messages have many keys; those that are not asked for are passed over.
Vec3<double> read_message_vector(const Json& json, const JsonPath& path, Mistakes& mistakes);

/// x, y, z, w; a quaternion of length zero turns nothing, as in MoveIt.
std::array<double, 4> read_message_quaternion(const Json& json, const JsonPath& path,
                                              Mistakes& mistakes);

/// geometry_msgs/Pose or Transform: `position` or `translation`, `orientation` or `rotation`, each
/// of which may be missing.
Affine<double> read_message_pose(const Json& json, const JsonPath& path, Mistakes& mistakes);

/// Seconds, of {secs, nsecs}, {sec, nanosec} or a number.
std::optional<double> read_message_duration(const Json& json, const JsonPath& path,
                                            Mistakes& mistakes);

/// A list of any length, null being an empty one.
std::vector<double> read_number_list(const Json& json, const JsonPath& path, Mistakes& mistakes);
std::vector<std::string> read_name_list(const Json& json, const JsonPath& path, Mistakes& mistakes);

/// The value of a key of an object; null if it is not there or is null.
const Json* member_of(const Json& json, std::string_view key);

/// The items of the list `key`, none if it is missing or null; anything else is a mistake.
const Json& list_of(const Json& json, std::string_view key, const JsonPath& path,
                    Mistakes& mistakes);

/// The text of a key; empty if it is missing.
std::string text_of(const Json& json, std::string_view key, const JsonPath& path,
                    Mistakes& mistakes);

}  // namespace minkray
