// SPDX-License-Identifier: MIT
// Measured figures of a test with their limits, for the table of `./run light`: stored in the
// report that --gtest_output=json: writes.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace minkray {

/// `name` has letters, digits and _ alone, and is reported once per test.
inline void tell_figure(const std::string& name, double measured, const std::string& asked) {
  std::ostringstream text;
  text.precision(3);
  text << measured << " | " << asked;
  ::testing::Test::RecordProperty("must_hold_" + name, text.str());
}

}  // namespace minkray
