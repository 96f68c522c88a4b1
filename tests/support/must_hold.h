// SPDX-License-Identifier: MIT
// Figures that a test has measured beside what they must be, for the table of `./run light`: they
// are kept in the report that --gtest_output=json: writes.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace minkray {

/// `name` has letters, digits and _ alone, and is told once a test.
inline void tell_figure(const std::string& name, double measured, const std::string& asked) {
  std::ostringstream text;
  text.precision(3);
  text << measured << " | " << asked;
  ::testing::Test::RecordProperty("must_hold_" + name, text.str());
}

}  // namespace minkray
