// SPDX-License-Identifier: MIT
// Parameters of tests that take time to make, made only where these tests are asked for. ctest runs
// each test in a process of its own, and GoogleTest makes the parameters of all in each of them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace minkray::testing {

/// Whether GoogleTest's filter can let a test of this suite pass. One that names whole tests, as
/// ctest does, lets no others pass; all other filters may.
inline bool may_be_asked_for(std::string_view suite) {
  const std::string filter = GTEST_FLAG_GET(filter);
  const bool names_whole_tests =
      !filter.empty() && filter.front() != '-' && filter.find_first_of("*?") == std::string::npos;
  return !names_whole_tests || filter.find(suite) != std::string::npos;
}

/// For INSTANTIATE_TEST_SUITE_P: what `make` returns, a vector, or nothing if no test of the suite
/// is asked for.
template <class Make>
auto values_asked_for(std::string_view suite, const Make& make) {
  using Values = std::decay_t<decltype(make())>;
  return ::testing::ValuesIn(may_be_asked_for(suite) ? Values(make()) : Values());
}

}  // namespace minkray::testing
