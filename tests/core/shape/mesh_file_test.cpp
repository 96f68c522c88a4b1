// SPDX-License-Identifier: MIT
#include "core/shape/mesh_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

namespace minkray {
namespace {

/// A file that lives as long as this.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& contents)
      : path_(testing::TempDir() + "minkray-mesh-" + name) {
    std::ofstream(path_, std::ios::binary) << contents;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::vector<Vec3<double>> vertices(const std::string& name, const std::string& contents) {
  return read_mesh_vertices(TemporaryFile(name, contents).path());
}

std::string complaint(const std::string& name, const std::string& contents) {
  try {
    vertices(name, contents);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// A binary STL of one triangle whose header starts with "solid", as some programs write it.
std::string binary_stl(const std::array<float, 9>& corners) {
  std::string bytes = "solid but binary";
  bytes.resize(80, ' ');
  bytes += std::string("\1\0\0\0", 4);
  bytes += std::string(12, '\0');
  for (const float coordinate : corners) {
    char raw[4];
    std::memcpy(raw, &coordinate, 4);
    bytes.append(raw, 4);
  }
  return bytes + std::string(2, '\0');
}

TEST(MeshFile, obj_vertices_are_read_to_the_last_bit) {
  const auto read = vertices("a.OBJ",
                             "# v 9 9 9\nv 0.1 0.3 -2.5e-3\nvn 1 0 0\n\tv +1 2 3 1.0\r\n"
                             "vt 0 0\nf 1 2 3\nv 1e-310 0 7");
  const std::vector<Vec3<double>> expected = {{0.1, 0.3, -2.5e-3}, {1, 2, 3}, {1e-310, 0, 7}};
  EXPECT_EQ(read, expected);
}

TEST(MeshFile, stl_vertices_are_read_from_text_and_from_binary) {
  const std::vector<Vec3<double>> expected = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}};
  EXPECT_EQ(vertices("a.stl",
                     "solid x\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n"
                     "   vertex 1 0 0\n   vertex 0 1 5e-1\n  endloop\n endfacet\nendsolid x\n"),
            expected);
  EXPECT_EQ(vertices("b.stl", binary_stl({0, 0, 0, 1, 0, 0, 0, 1, 0.5f})), expected);
}

TEST(MeshFile, whatever_is_wrong_is_told) {
  EXPECT_EQ(complaint("c.obj", "v 1 2 3\nv 1 x 3\n"),
            "line 2: a vertex must be three finite numbers");
  EXPECT_EQ(complaint("d.obj", "v 1 2\n"), "line 1: a vertex must be three finite numbers");
  EXPECT_EQ(complaint("e.obj", "v 1 2 1e999\n"), "line 1: a vertex must be three finite numbers");
  EXPECT_EQ(complaint("f.obj", "v 1 2 nan\n"), "line 1: a vertex must be three finite numbers");
  EXPECT_EQ(complaint("g.obj", ""), "has no vertices");
  EXPECT_EQ(complaint("h.stl", "solid nothing\nendsolid\n"), "has no vertices");
  EXPECT_EQ(complaint("i.ply", "v 1 2 3\n"), "must be a mesh file that ends in .obj or .stl");
  EXPECT_EQ(complaint("j.stl", binary_stl({0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0, 0,
                                           1, 0.5f})),
            "triangle 1: a vertex must be three finite numbers");
  EXPECT_THROW(read_mesh_vertices("no-such-file.obj"), std::runtime_error);
}

}  // namespace
}  // namespace minkray
