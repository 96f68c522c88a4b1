// SPDX-License-Identifier: MIT
// Properties that must hold for whatever rapidcheck draws, and their smallest counterexample if
// they do not. The seed is fixed: a suite that passes, passes.
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <sstream>
#include <string>

#include "core/shape/shape.h"
#include "renderer/member_json/shape_json.h"
#include "tests/fuzz/shape_from_bytes.h"

namespace minkray::testing {

/// Checks a property for many draws; it draws by *rc::gen and fails by RC_ASSERT.
template <class Property>
void expect_always(Property&& property, int draws) {
  rc::detail::TestParams params;
  params.seed = 20040601;
  params.maxSuccess = draws;
  rc::detail::TestMetadata metadata;
  metadata.description = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const auto result = rc::detail::checkTestable(std::forward<Property>(property), metadata, params);
  if (result.template is<rc::detail::SuccessResult>()) return;
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  ADD_FAILURE() << text.str();
}

/// Bytes to make shapes of, as the fuzzer does: they shrink to simpler shapes.
inline std::string draw_bytes(int count) {
  std::string bytes;
  for (const int byte : *rc::gen::container<std::vector<int>>(static_cast<std::size_t>(count),
                                                              rc::gen::inRange(0, 256)))
    bytes += static_cast<char>(byte);
  return bytes;
}

/// Any shape of ordinary size, nested up to `depth` deep; a counterexample is reported as JSON.
inline Shape draw_shape(int depth = 2) {
  const std::string drawn = draw_bytes(96);
  fuzz::Bytes bytes(drawn);
  Shape shape = fuzz::shape_from(bytes, false, depth);
  RC_LOG() << write_shape(shape).dump() << '\n';
  return shape;
}

inline Vec3<double> draw_direction() {
  const auto component =
      rc::gen::map(rc::gen::inRange(-1000, 1001), [](int x) { return x / 1000.0; });
  const double x = *component, y = *component, z = *component;
  return {x, y, z};
}

/// A turn, by up to half a turn.
inline Mat3<double> draw_rotation() {
  const Vec3<double> half = draw_direction();
  return rotation_matrix<double>(half.x(), half.y(), half.z(), 1);
}

}  // namespace minkray::testing
