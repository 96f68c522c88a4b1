// SPDX-License-Identifier: MIT
// Errors that are not defects of this program. The command line maps each to its exit code
// (renderer/cli/exit_code.h); what() is for the user, one message per line.
#pragma once

#include <stdexcept>

namespace minkray {

/// Input that cannot be used: a scene, a query, a mesh.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that cannot be written.
class CannotWrite : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Arguments that do not go together, or a value that an option does not take.
class WrongUsage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace minkray
