// SPDX-License-Identifier: MIT
// Normals, texture coordinates and materials of mesh files.
#include "core/files/mesh_attributes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/files/mesh_file.h"
#include "core/files/mtl_file.h"
#include "tests/support/meshes.h"
#include "tests/support/messages.h"

namespace minkray {
namespace {

constexpr std::uint32_t no_number = MeshAttributes::none;
using Numbers = MeshAttributes::Numbers;

MeshAttributes attributes_of_obj(const std::string& obj) {
  MeshTriangles triangles;
  MeshAttributes attributes;
  mesh_vertices(obj, MeshFormat::obj, &triangles, &attributes);
  EXPECT_EQ(attributes.material_of.size(), triangles.corners.size());
  settle(attributes);
  return attributes;
}

constexpr const char* obj_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(MeshAttributes, of_an_obj_go_with_its_triangles) {
  const MeshAttributes read_ones =
      attributes_of_obj(std::string("mtllib a b.mtl\n") + obj_square +
                        "vt 0 0\nvt 1 0.25\nvn 0 0 2\nvn 0 3 4\n"
                        "usemtl red paint\nf 1/1/1 2/2/1 3/2/2 4/1/-1\n"
                        "usemtl blue\nf 1//1 2//1 3//1\nusemtl red paint\nf 1 2 3\n");
  EXPECT_EQ(read_ones.materials, (std::vector<std::string>{"red paint", "blue"}));
  EXPECT_EQ(read_ones.libraries, std::vector<std::string>{"a b.mtl"});
  EXPECT_EQ(read_ones.material_of, (std::vector<std::uint32_t>{0, 0, 1, 0}));
  EXPECT_EQ(
      read_ones.normal_of,
      (std::vector<Numbers>{{0, 0, 1}, {0, 1, 1}, {0, 0, 0}, {no_number, no_number, no_number}}));
  EXPECT_EQ(read_ones.uv_of,
            (std::vector<Numbers>{
                {0, 1, 1}, {0, 1, 0}, MeshAttributes::no_numbers, MeshAttributes::no_numbers}));
  EXPECT_EQ(read_ones.normals[0], Vec3<float>(0, 0, 1));
  EXPECT_LT((read_ones.normals[1] - Vec3<float>(0, 0.6F, 0.8F)).norm(), 1e-6F);
  EXPECT_EQ(read_ones.uvs[1], (std::array<float, 2>{1, 0.75F}));  // rows of pictures go down
  EXPECT_EQ(read_ones.bad_normals + read_ones.bad_uvs, 0u);
}

TEST(MeshAttributes, that_are_wrong_are_left_out_and_counted) {
  for (const char* face :
       {"f 1//9 2//1 3//1", "f 1//0 2//1 3//1", "f 1//-7 2//1 3//1", "f 1//x 2//1 3//1",
        "f 1//2 2//1 3//1", "f 1//3 2//1 3//1", "f 1 2//1 3//1", "f 1//99999999999 2//1 3//1"}) {
    const MeshAttributes found =
        attributes_of_obj(std::string(obj_square) + "vn 0 0 1\nvn 0 0 0\nvn nan 0 1\n" + face +
                          "\nf 1//1 2//1 3//1\n");
    EXPECT_EQ(found.bad_normals, 1u) << face;
    EXPECT_EQ(found.normal_of, (std::vector<Numbers>{MeshAttributes::no_numbers, {0, 0, 0}}))
        << face;
    ASSERT_EQ(notes_of(found).size(), 1u);
    EXPECT_TRUE(has(notes_of(found)[0], "normals of 1 triangle"));
  }
  const MeshAttributes found =
      attributes_of_obj(std::string(obj_square) + "vt 0 inf\nf 1/1 2/1 3/1\n");
  EXPECT_EQ(found.bad_uvs, 1u);
  EXPECT_FALSE(found.any());
}

TEST(MeshAttributes, cost_nothing_where_nobody_asks) {
  MeshTriangles triangles;
  EXPECT_EQ(mesh_vertices(std::string(obj_square) + "vn a b\nvt\nf 1/x/y 2 3\n", MeshFormat::obj,
                          &triangles)
                .size(),
            4u);
}

TEST(MeshAttributes, of_some_triangles_and_of_several_meshes_keep_their_corners) {
  MeshAttributes all;
  for (float i = 0; i < 4; ++i) all.uvs.push_back({i, 0});
  all.uv_of = {{0, 1, 2}, MeshAttributes::no_numbers, {3, 2, 3}};
  all.material_of = {0, no_number, 1};
  const std::vector<std::uint32_t> last = {2};
  MeshAttributes some = attributes_of(all, last);
  EXPECT_EQ(some.uvs, (std::vector<std::array<float, 2>>{{2, 0}, {3, 0}}));
  EXPECT_EQ(some.uv_of, std::vector<Numbers>({{1, 0, 1}}));
  MeshAttributes joined;
  append(joined, 2, some, 1, 5);  // behind two triangles without any
  append(joined, 3, all, 3, 0);
  EXPECT_EQ(joined.uv_of[1], MeshAttributes::no_numbers);
  EXPECT_EQ(joined.uv_of[2], (Numbers{1, 0, 1}));
  EXPECT_EQ(joined.uv_of[5], (Numbers{5, 4, 5}));
  EXPECT_EQ(joined.material_of,
            (std::vector<std::uint32_t>{no_number, no_number, 6, 0, no_number, 1}));
}

TEST(MeshAttributes, normals_are_mapped_by_the_inverse_transpose) {
  MeshAttributes one;
  one.normals = {attribute_normal({1, 1, 0})};
  const Vec3<double> scale(2, 1, -1);
  map_normals(one, scale.cwiseInverse().asDiagonal());
  EXPECT_LT((one.normals[0].cast<double>() - Vec3<double>(1, 2, 0).normalized()).norm(), 1e-6);
}

TEST(SmoothNormals, of_a_ball_are_near_its_radii_and_creases_stay_sharp) {
  const testing::Surface ball = testing::bumpy_ball(40, 60);
  const MeshAttributes smooth = smooth_normals(ball.vertices, ball.triangles, std::numbers::pi);
  ASSERT_EQ(smooth.normal_of.size(), ball.triangles.size());
  EXPECT_EQ(smooth.normals.size(), ball.vertices.size());
  const testing::Surface block = testing::block({1, 2, 3});
  const TriangleMesh mesh = block.mesh();
  const MeshAttributes sharp = smooth_normals(block.vertices, block.triangles, 0.5);
  const MeshAttributes round = smooth_normals(block.vertices, block.triangles, std::numbers::pi);
  for (std::uint32_t t = 0; t < mesh.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT((sharp.normals[sharp.normal_of[t][k]].cast<double>() - mesh.normal(t)).norm(),
                1e-6);
      const Vec3<double> corner = mesh.corner(t, k).cwiseQuotient(Vec3<double>(1, 2, 3));
      EXPECT_LT((round.normals[round.normal_of[t][k]].cast<double>() - corner.normalized()).norm(),
                1e-6);
    }
}

TEST(MtlFile, has_colours_and_pictures_behind_options) {
  std::map<std::string, MtlMaterial> found;
  read_mtl(
      "# a\nKd 1 1 1\nnewmtl red paint\nKd 1 0.5 0 # orange\nd 0.5\nnewmtl b\n"
      "map_Kd -s 2 2 2 -bm 1 my brick.png\nnewmtl c\nKd 1 2\nmap_Kd -o 0.5 x.jpg\n",
      found);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(*found["red paint"].colour, (std::array<double, 3>{1, 0.5, 0}));
  EXPECT_EQ(found["red paint"].opacity, 0.5);
  EXPECT_EQ(found["b"].picture, "my brick.png");
  EXPECT_EQ(found["c"].picture, "x.jpg");
  EXPECT_FALSE(found["c"].colour);
}

}  // namespace
}  // namespace minkray
