// SPDX-License-Identifier: MIT
// Parameters of tests that take time to make, made only if these tests are selected. ctest runs
// each test in a process of its own, and GoogleTest makes the parameters of all in each of them.
#pragma once

#include <cxxabi.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <type_traits>
#include <typeinfo>

namespace minkray::testing {

/// True if GoogleTest's filter can let a test of this suite pass. A filter that names whole tests,
/// as ctest does, lets no others pass; all other filters may.
template <class Suite>
bool may_be_asked_for() {
  const std::string filter = GTEST_FLAG_GET(filter);
  const bool names_whole_tests =
      !filter.empty() && filter.front() != '-' && filter.find_first_of("*?") == std::string::npos;
  // The name is the class's own: one that were written here could be wrong, and leave tests out.
  const std::unique_ptr<char, void (*)(void*)> with_namespaces(
      abi::__cxa_demangle(typeid(Suite).name(), nullptr, nullptr, nullptr), std::free);
  const std::string name(with_namespaces.get());
  return !names_whole_tests || filter.find(name.substr(name.rfind(':') + 1)) != std::string::npos;
}

/// For INSTANTIATE_TEST_SUITE_P: the result of `make`, a vector, or nothing if no test of the
/// suite is selected.
template <class Suite, class Make>
auto values_asked_for(const Make& make) {
  using Values = std::decay_t<decltype(make())>;
  return ::testing::ValuesIn(may_be_asked_for<Suite>() ? Values(make()) : Values());
}

}  // namespace minkray::testing
