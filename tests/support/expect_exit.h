// SPDX-License-Identifier: MIT
// Expectations of a program that has ended.
#pragma once

#include "tests/support/messages.h"
#include "tests/support/program.h"

namespace minkray {

/// Expects the exit code, and these parts of stderr; a failure names the caller's line.
inline void expect_exit(int code, const ProgramOutcome& outcome,
                        std::initializer_list<std::string_view> parts_of_err = {},
                        std::source_location place = std::source_location::current()) {
  if (outcome.exit_code != code)
    ADD_FAILURE_AT(place.file_name(), static_cast<int>(place.line()))
        << "exit code " << outcome.exit_code << ", not " << code << "\n"
        << outcome.out << outcome.err;
  expect_parts(outcome.err, parts_of_err, place);
}

}  // namespace minkray
