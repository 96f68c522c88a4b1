// SPDX-License-Identifier: MIT
// Reading whole files that somebody named. Only regular files: a pipe or a terminal may never end,
// and waiting for one looks like hanging.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace minkray {

/// The contents. Throws std::runtime_error that says what is wrong with the file, without its name,
/// if it cannot be read, is no regular file, or holds more than `most_bytes` (of a larger file
/// nothing is read). Never waits for another process.
std::string read_regular_file(const std::filesystem::path& path, std::size_t most_bytes);

}  // namespace minkray
