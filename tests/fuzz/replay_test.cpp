// SPDX-License-Identifier: MIT
// The inputs that fuzzing is begun with, and those on which it once found something, with every
// build of the suite.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/fuzz/inputs.h"
#include "tests/fuzz/target.h"

namespace minkray::fuzz {
namespace {

using Check = std::string (*)(std::string_view);

struct Target {
  const char* name;
  Check check;
};

class Replay : public ::testing::TestWithParam<Target> {};

TEST_P(Replay, kept_inputs_keep_every_promise) {
  int count = 0;
  for (const char* kind : {"corpus", "findings"}) {
    for (const SourceFile& input : kept_inputs(GetParam().name, kind)) {
      EXPECT_EQ(GetParam().check(input.text), "") << input.name;
      ++count;
    }
  }
  EXPECT_GT(count, 3) << "inputs in tests/fuzz/inputs/" << GetParam().name << ".json";
}

INSTANTIATE_TEST_SUITE_P(
    Targets, Replay,
    ::testing::Values(Target{"scene", check_scene}, Target{"query", check_queries},
                      Target{"mesh", check_mesh}, Target{"parts", check_mesh_parts},
                      Target{"mjcf", check_mjcf}, Target{"urdf", check_urdf},
                      Target{"sdf", check_sdf}, Target{"gltf", check_gltf},
                      Target{"image", check_image}, Target{"cast", check_cast},
                      Target{"contact", check_contact}, Target{"c_abi", check_c_abi}),
    [](const auto& instance) { return std::string(instance.param.name); });

TEST(CastQueries, that_were_answered_wrongly_once) {
  std::ifstream file(source_folder() / "tests/fuzz/casts.jsonl");
  int count = 0;
  for (std::string line; std::getline(file, line); ++count)
    EXPECT_EQ(check_cast_query(line), "") << line;
  EXPECT_GT(count, 10);
}

}  // namespace
}  // namespace minkray::fuzz
