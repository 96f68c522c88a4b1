// SPDX-License-Identifier: MIT
// Errors of the library's calls: code and message.
#pragma once

#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <string>

#include "tests/support/messages.h"

using minkray::expect_parts;
using minkray::has;

/// Message of the error that the call ends with, which must have the code; "" if there is none.
template <class Call>
std::string error_of(const Call& call, int code = MINKRAY_WRONG_USE) {
  try {
    call();
  } catch (const minkray::Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  return "";
}
