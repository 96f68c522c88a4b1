// SPDX-License-Identifier: MIT
// Reads single values: each function returns the value, or adds an error with what was expected and
// found.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "core/support/field.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

/// "got -1", "got \"abc\"", "got a list of 2": what was found, for the end of a message.
std::string found(const Json& json);

/// "> 0", ">= 0" and so on; empty if any number will do.
std::string_view constraint(Range range);

/// True if a finite number is in the range.
bool in_range(double value, Range range);

std::optional<double> read_number(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                  Range range = Range::any);

/// A whole number between lowest and highest.
std::optional<int> read_integer(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                int lowest, int highest);

std::optional<std::string> read_string(const Json& json, const JsonPath& path, Mistakes& mistakes);

std::optional<bool> read_bool(const Json& json, const JsonPath& path, Mistakes& mistakes);

/// A list of exactly `count` numbers.
std::optional<std::vector<double>> read_numbers(const Json& json, const JsonPath& path,
                                                Mistakes& mistakes, std::size_t count,
                                                Range range = Range::any);

/// A list of three numbers.
std::optional<Vec3<double>> read_vector(const Json& json, const JsonPath& path, Mistakes& mistakes,
                                        Range range = Range::any);

/// A list of points, at least `least` and at most `most` of them.
std::optional<std::vector<Vec3<double>>> read_points(const Json& json, const JsonPath& path,
                                                     Mistakes& mistakes, std::size_t least,
                                                     std::size_t most);

}  // namespace minkray
