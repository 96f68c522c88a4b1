// SPDX-License-Identifier: MIT
// Prefixes messages with the name of the file that they are about.
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include "renderer/base/errors.h"

namespace minkray {

/// Description of an error while a file was read, in words for the user.
inline std::string what_of(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) ? "not enough memory to read it"
                                                     : error.what();
}

/// Runs `work`, which reads the file. Mistakes are BadInput that begins with the file's name.
template <class Work>
auto of_file(const std::string& file, const Work& work) {
  try {
    return work();
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    throw BadInput(what.starts_with(file + ": ") ? what : file + ": " + what);
  } catch (const std::bad_alloc& error) {
    throw BadInput(file + ": " + what_of(error));
  }
}

}  // namespace minkray
