// SPDX-License-Identifier: MIT
// Objects of equal shapes share what is large, whatever made them.
#include <gtest/gtest.h>
#include <minkray/minkray.h>

#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>

#include "tests/support/temporary_folder.h"

#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
#include <malloc.h>
#define MINKRAY_HAS_MALLINFO
#endif

namespace {

namespace mk = minkray;

#if defined(MINKRAY_HAS_MALLINFO) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

std::size_t bytes_in_use() {
  const struct mallinfo2 all = ::mallinfo2();
  return all.uordblks + all.hblkhd;
}

/// A hull of 64 points took 26 kB in each object of a file.
TEST(SceneMemory, objects_of_files_with_equal_shapes_share_their_points) {
  constexpr int count = 200;
  std::ostringstream points;
  for (int i = 0; i < 64; ++i) {
    const double z = 1 - (2 * i + 1) / 64.0, r = std::sqrt(1 - z * z), angle = 2.4 * i;
    points << (i > 0 ? ", " : "") << '[' << r * std::cos(angle) << ", " << r * std::sin(angle)
           << ", " << z << ']';
  }
  const minkray::TemporaryFolder folder;
  std::ofstream file(folder / "hulls.json");
  file << R"({"version": 2, "objects": [)";
  for (int i = 0; i < count; ++i)
    file << (i > 0 ? "," : "") << R"({"shape": {"type": "rounded", "radius": 0.1, "shape": )"
         << R"({"type": "hull", "points": [)" << points.str() << R"(]}}, "transform": )"
         << R"({"translate": [)" << 3 * i << ", 0, 0]}}\n";
  file << "]}";
  file.close();
  mk::Scene scene;
  scene.add(mk::sphere(1), mk::translation({0, 9, 0}));
  const std::size_t before = bytes_in_use();
  scene.add_file((folder / "hulls.json").c_str());
  const double each = static_cast<double>(bytes_in_use() - before) / count;
  scene.commit();
  EXPECT_LT(each, 4000);
  EXPECT_EQ(scene.size(), count + 1u);
  EXPECT_NEAR(scene.cast({{30, -9, 0}, {0, 1, 0}}).t, 7.9, 0.1);
}

#endif

}  // namespace
