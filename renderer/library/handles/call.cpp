// SPDX-License-Identifier: MIT
#include "renderer/library/handles/call.h"

#include <exception>
#include <limits>
#include <new>

#include "renderer/base/errors.h"

namespace minkray {
namespace {

/// Message of this thread's last failed call. The only state that calls keep, since C has no better
/// place for a text.
std::string& kept_error() {
  thread_local std::string text;
  return text;
}

int keep(minkray_code code, const char* function, const char* what) {
  kept_error() = std::string(function) + ": " + what;
  return code;
}

}  // namespace

void wrong_use(const std::string& what) {
  throw CallError(MINKRAY_WRONG_USE, what);
}

void wrong_null(const char* argument) {
  wrong_use(std::string(argument) + ": must not be NULL");
}

void require_room(std::size_t count, std::size_t bytes_each, const char* argument) {
  constexpr auto most_bytes = static_cast<std::size_t>(std::numeric_limits<std::ptrdiff_t>::max());
  if (count > most_bytes / bytes_each)
    wrong_use(std::string(argument) + ": must fit into memory (got " + std::to_string(count) + ")");
}

int keep_error(const char* function) noexcept {
  try {
    try {
      throw;
    } catch (const CallError& error) {
      return keep(error.code(), function, error.what());
    } catch (const BadInput& error) {
      return keep(MINKRAY_BAD_INPUT, function, error.what());
    } catch (const WrongUsage& error) {
      return keep(MINKRAY_WRONG_USE, function, error.what());
    } catch (const CannotWrite& error) {
      return keep(MINKRAY_BAD_INPUT, function, error.what());
    } catch (const std::bad_alloc&) {
      return keep(MINKRAY_NO_MEMORY, function, "out of memory");
    } catch (const std::exception& error) {
      return keep(MINKRAY_DEFECT, function, error.what());
    } catch (...) {
      return keep(MINKRAY_DEFECT, function, "an unknown error");
    }
  } catch (...) {  // not even memory for the text
    return MINKRAY_NO_MEMORY;
  }
}

const char* last_error() noexcept {
  try {
    return kept_error().c_str();
  } catch (...) {
    return "";
  }
}

}  // namespace minkray
