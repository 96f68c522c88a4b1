// SPDX-License-Identifier: MIT
#include "core/files/mesh_file.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cstring>

#include "core/files/mesh_parts.h"
#include "tests/support/messages.h"
#include "tests/support/temporary_folder.h"

namespace minkray {
namespace {

/// A file that lives as long as this.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& contents)
      : path_(folder_.write(name, contents)) {}
  const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder folder_;
  std::filesystem::path path_;
};

std::vector<Vec3<double>> vertices(const std::string& name, const std::string& contents) {
  return read_mesh_vertices(TemporaryFile(name, contents).path());
}

std::string complaint(const std::string& name, const std::string& contents) {
  return message_of<std::runtime_error>([&] { vertices(name, contents); });
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
  EXPECT_EQ(complaint("k.stl", ""),
            "must begin with \"solid\", or be a binary STL of at least 84 bytes (got 0)");
  EXPECT_EQ(complaint("l.stl", "facet normal 0 0 1\n" + std::string(100, ' ')),
            "must begin with \"solid\", or be a binary STL: its triangle count must be at most "
            "10737418 (got 538976288, in a file that has room for 0)");
  std::string wrong_count = binary_stl({0, 0, 0, 1, 0, 0, 0, 1, 0.5f});
  wrong_count.replace(0, 5, "other");  // else it is read as text
  std::fill_n(wrong_count.begin() + 80, 4, '\xff');
  EXPECT_EQ(complaint("m.stl", wrong_count),
            "must begin with \"solid\", or be a binary STL: its triangle count must be at most "
            "10737418 (got 4294967295, in a file that has room for 1)");
  EXPECT_EQ(complaint("i.ply", "v 1 2 3\n"), "must be a mesh file that ends in .obj or .stl");
  EXPECT_EQ(complaint("j.stl", binary_stl({0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0, 0,
                                           1, 0.5f})),
            "triangle 1: a vertex must be three finite numbers");
  EXPECT_THROW(read_mesh_vertices("no-such-file.obj"), std::runtime_error);
}

/// Description of an error in a file's contents; empty if there is none.
std::string complaint(std::string_view contents, MeshFormat format) {
  try {
    EXPECT_FALSE(mesh_vertices(contents, format).empty());
  } catch (const std::runtime_error& error) {
    EXPECT_STRNE(error.what(), "");
    return error.what();
  }
  return "";
}

TEST(MeshFile, faces_without_their_vertices_are_refused) {
  const auto obj = [](std::string_view text) { return complaint(text, MeshFormat::obj); };
  EXPECT_EQ(obj("v 0 0 0\nv 1 0 0\nf 1 2 7\n"),
            "line 3: a face names vertex 7, but the file has 2 vertices (is it cut off?)");
  EXPECT_EQ(obj("v 0 0 0\nf -1 -2 1\nv 1 0 0\n"),
            "line 2: a face names vertex -2, but there are 1 vertices above it");
  const std::string not_whole =
      "line 2: a face must name its vertices by whole numbers, from 1 or -1 on";
  for (const std::string word : {"0", "x", "1.5", "/1", "-", "1-", "+", "+-1", "++1",
                                 "9223372036854775808", "-9223372036854775809"})
    EXPECT_EQ(obj("v 0 0 0\nf 1 " + word + "\n"), not_whole) << word;
  // 2^32 + 1 and 2^63 - 1, which must not wrap.
  expect_messages(obj, {{"v 0 0 0\nf 1 1 4294967297\n", "vertex 4294967297"},
                        {"v 0 0 0\nf 9223372036854775807", "vertex 922337203685"},
                        {"v 0 0 0\nf -9223372036854775808", "vertex -92233720368"}});
  // Vertices may follow their faces, and lines continue behind a backslash.
  EXPECT_EQ(obj("f 1/1/1 2//2 3/3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2/1 -1//4 # 9\nf 1 2 \\\n3\n"),
            "");
}

TEST(MeshFile, an_obj_cut_off_anywhere_is_refused_or_the_vertices_that_are_there) {
  const std::string text =
      "# five\nv 0 0 0\nv 1.25 0 0\nv 0 1.5 0\nf 1 2 3\nv 0 0 -1e1\r\nf -1/2/3 1//2 4\nv 1 1 1\n";
  const std::vector<Vec3<double>> all = mesh_vertices(text, MeshFormat::obj);
  ASSERT_EQ(all.size(), 5u);
  int refused = 0;
  for (std::size_t length = 0; length < text.size(); ++length) {
    std::vector<Vec3<double>> found;
    try {
      found = mesh_vertices(text.substr(0, length), MeshFormat::obj);
    } catch (const std::runtime_error&) {
      ++refused;
      continue;
    }
    ASSERT_LE(found.size(), all.size()) << length;
    // A digit of the last one may be missing.
    for (std::size_t i = 0; i + 1 < found.size(); ++i) EXPECT_EQ(found[i], all[i]) << length;
  }
  EXPECT_GT(refused, 30);
  EXPECT_LT(refused, 80);
}

constexpr std::string_view two_solids =
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
    "endloop\nendfacet\nendsolid a\n"
    "SOLID b c\r\nFACET normal 0 0 1\r\nVERTEX 0 0 5\r\nENDSOLID b c \r\n\r\n";

TEST(MeshFile, a_text_stl_cut_off_anywhere_is_refused) {
  EXPECT_EQ(mesh_vertices(two_solids, MeshFormat::stl).size(), 4u);
  const std::size_t first_end = two_solids.find("endsolid") + 8, second = two_solids.find("SOLID");
  const std::size_t second_end = two_solids.find("ENDSOLID") + 8;
  for (std::size_t length = 0; length < two_solids.size(); ++length) {
    // Without the second solid it is a whole file; without the last one's name, too.
    const bool is_whole = (length >= first_end && length <= second) || length >= second_end;
    EXPECT_EQ(complaint(two_solids.substr(0, length), MeshFormat::stl).empty(), is_whole) << length;
  }
  EXPECT_EQ(complaint(two_solids.substr(0, second + 20), MeshFormat::stl),
            "is cut off: the solid of line 10 has no \"endsolid\"");
}

TEST(MeshFile, a_text_stl_on_one_line_is_read_and_refused_where_it_is_cut_off) {
  const std::string facet =
      " facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0.5 endloop endfacet";
  const std::vector<Vec3<double>> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}};
  for (const std::string name : {"", " x", " vertex #3 endsolid"}) {
    for (const std::string end : {"endsolid", "end solid", "EndSolid", "END\tSOLID"}) {
      const std::string text = "solid" + name + facet + " " + end;
      EXPECT_EQ(mesh_vertices(text, MeshFormat::stl), corners) << text;
      EXPECT_EQ(mesh_vertices(text + name, MeshFormat::stl), corners) << text;
      EXPECT_EQ(mesh_vertices(text + " x solid y" + facet + " " + end, MeshFormat::stl).size(), 6u);
      for (std::size_t length = 0; length < text.size(); ++length)
        EXPECT_NE(complaint(text.substr(0, length), MeshFormat::stl), "") << length << text;
    }
  }
}

TEST(MeshFile, comments_and_whatever_stands_behind_a_text_stl_do_not_matter) {
  const std::string comment = "\n  # vertex 9 9 9 endsolid\n#\n";
  const std::string text = comment + "solid a" + comment + "facet normal 0 0 1\nvertex 1 2 3 # 4" +
                           comment + "endfacet\nendsolid";
  const std::vector<Vec3<double>> corner = {{1, 2, 3}};
  for (const std::string_view behind :
       {std::string_view("\0\0\0", 3), std::string_view("\n\0", 2), std::string_view("\x1a"),
        std::string_view("\n\x1a\n"), std::string_view("\n# solid\n"),
        std::string_view("\n\nmade by hand\n"), std::string_view(" a solid")})
    EXPECT_EQ(mesh_vertices(text + std::string(behind), MeshFormat::stl), corner) << behind;
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_NE(complaint(text.substr(0, length), MeshFormat::stl), "") << length;
  EXPECT_EQ(complaint(text + "\nfacet normal 0 0 1\n", MeshFormat::stl),
            "line 13: a facet must be between \"solid\" and \"endsolid\"");
}

// The mark hid the first vertex of an OBJ, and a file of \r was one line, with no vertex at all.
TEST(MeshFile, byte_order_marks_and_the_kind_of_line_ends_do_not_matter) {
  const std::string obj = "v 1 2 3\n\nv 4 5 6\nf 1 2\n";
  const std::string stl(two_solids.substr(0, two_solids.find("SOLID")));
  for (const std::string mark : {"", "\xef\xbb\xbf"}) {
    for (const std::string line_end : {"\n", "\r", "\r\n"}) {
      const auto written = [&](const std::string& text) {
        std::string result = mark;
        for (const char c : text) result += c == '\n' ? line_end : std::string(1, c);
        return result;
      };
      EXPECT_EQ(mesh_vertices(written(obj), MeshFormat::obj), mesh_vertices(obj, MeshFormat::obj));
      EXPECT_EQ(mesh_vertices(written(stl), MeshFormat::stl), mesh_vertices(stl, MeshFormat::stl));
      EXPECT_EQ(complaint(written(obj + "v x"), MeshFormat::obj),
                "line 5: a vertex must be three finite numbers");
      EXPECT_EQ(complaint(written("# 1\n\nsolid\nvertex x\nendsolid"), MeshFormat::stl),
                "line 4: a vertex must be three finite numbers");
      EXPECT_EQ(complaint(written("\nsolid\nvertex 1 2 3\nend"), MeshFormat::stl),
                "is cut off: the solid of line 2 has no \"endsolid\"");
    }
  }
}

TEST(MeshFile, obj_lines_have_plus_signs_comments_and_continuations) {
  const std::vector<Vec3<double>> expected = {{1, 2, 3}, {4, 5, 6}};
  EXPECT_EQ(mesh_vertices("# C:\\\nv 1 2 3#\\\nmtllib C:\\\nv 4 \\\r\n5\\ \n\t6\nf +1 2 -1#c\n",
                          MeshFormat::obj),
            expected);
  EXPECT_EQ(mesh_vertices("v\\\n1 2 3\n v\\ \n4 5 6\nf\\\n1 2\nv\\ 9\nf\\ 9\n", MeshFormat::obj),
            expected);
  // A blank line ends what is continued.
  EXPECT_EQ(mesh_vertices("v 1 2 3 \\\n\nv 4 5 6\n", MeshFormat::obj), expected);
  const auto obj = [](std::string_view text) { return complaint(text, MeshFormat::obj); };
  // Lines are reported by their first line, and those behind them by their own number.
  EXPECT_EQ(obj("v 1 \\\n2 \\\nx\n"), "line 1: a vertex must be three finite numbers");
  EXPECT_EQ(obj("v 1 \\\n2 \\\n3\nv +-1 2 3\n"), "line 4: a vertex must be three finite numbers");
  EXPECT_EQ(obj("v 1 2 3\nf 1 \\\n2\n"),
            "line 2: a face names vertex 2, but the file has 1 vertices (is it cut off?)");
  EXPECT_EQ(obj("v 1 2 3\nf 1 \\\n"), "line 2: is cut off: no line follows its \"\\\"");
  EXPECT_EQ(obj("v 1 2 3 \\"), "line 1: is cut off: no line follows its \"\\\"");
}

TEST(MeshFile, a_binary_stl_may_be_longer_than_its_triangles_but_not_shorter) {
  for (const std::string header : {"binary", "solid but binary", " \n solid\nendsolid\n", "",
                                   "\xef\xbb\xbfsolid", "# a\nsolid"}) {
    std::string bytes = binary_stl({0, 0, 0, 1, 0, 0, 0, 1, 0.5f});
    bytes.replace(0, 80, header + std::string(80 - header.size(), ' '));
    bytes += bytes.substr(84);
    bytes[80] = '\2';
    EXPECT_EQ(mesh_vertices(bytes, MeshFormat::stl).size(), 6u);
    for (std::size_t length = 0; length < bytes.size(); ++length)
      EXPECT_NE(complaint(bytes.substr(0, length), MeshFormat::stl), "") << header << length;
    EXPECT_EQ(complaint(bytes.substr(0, 183), MeshFormat::stl),
              "a binary STL of 2 triangles must have at least 184 bytes (got 183)");
    EXPECT_EQ(complaint(bytes.substr(0, 84), MeshFormat::stl),
              "a binary STL of 2 triangles must have at least 184 bytes (got 84)");
    EXPECT_EQ(mesh_vertices(bytes + "\n\n", MeshFormat::stl),
              mesh_vertices(bytes, MeshFormat::stl));
    EXPECT_EQ(mesh_vertices(bytes + std::string(72, '\0'), MeshFormat::stl).size(), 6u);
  }
  EXPECT_EQ(complaint(std::string(84, '\0'), MeshFormat::stl), "has no vertices");
}

TEST(MeshFile, bytes_that_are_not_utf_8_matter_only_in_numbers) {
  const std::string wild = "\xff\xc3(\xe2\x82\x1b[31m";
  EXPECT_EQ(complaint("# " + wild + "\no " + wild + "\nv 1 2 3\nf 1 # " + wild, MeshFormat::obj),
            "");
  EXPECT_EQ(complaint("solid " + wild + "\nvertex 1 2 3\n" + wild + "\nendsolid " + wild,
                      MeshFormat::stl),
            "");
  // Messages show nothing of it.
  EXPECT_EQ(complaint("v 1 2 " + wild, MeshFormat::obj),
            "line 1: a vertex must be three finite numbers");
  EXPECT_EQ(complaint("v 1 2 3\nf 1 " + wild, MeshFormat::obj),
            "line 2: a face must name its vertices by whole numbers, from 1 or -1 on");
  EXPECT_EQ(complaint("solid\nvertex 1 2 3" + wild + "\nendsolid", MeshFormat::stl),
            "line 2: a vertex must be three finite numbers");
  EXPECT_EQ(complaint("solid\nvertex 1 2 3\nendsolid\n" + wild, MeshFormat::stl), "");
}

// A second reader once found the parts. That reader parsed another language than the first for OBJ
// and STL, so that bodies of valid files were in no part, or in another body's, without an error.

constexpr std::array splits = {MeshSplit::groups, MeshSplit::components};

std::string complaint(std::string_view contents, MeshFormat format, MeshSplit split) {
  return message_of<std::runtime_error>([&] { mesh_parts(contents, format, split); });
}

using Parts = std::vector<std::vector<std::uint32_t>>;

/// With each kind of line ends, and with a byte order mark.
std::vector<std::string> as_editors_write(const std::string& text) {
  std::vector<std::string> files;
  for (const std::string mark : {"", "\xef\xbb\xbf"}) {
    for (const std::string line_end : {"\n", "\r", "\r\n"}) {
      files.push_back(mark);
      for (const char c : text) files.back() += c == '\n' ? line_end : std::string(1, c);
    }
  }
  return files;
}

/// The file has these parts, by its groups and by its components, of the vertices that it has
/// unsplit.
void expect_parts(MeshFormat format, const std::string& text, const Parts& expected) {
  for (const std::string& file : as_editors_write(text)) {
    for (const MeshSplit split : splits) {
      const MeshParts mesh = mesh_parts(file, format, split);
      EXPECT_EQ(mesh.parts, expected) << file;
      EXPECT_EQ(mesh.vertices, mesh_vertices(file, format)) << file;
    }
  }
}

const std::string eight_vertices =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 10 0 0\nv +1.1e1 0 0\nv\t10 1e0 0 1\n v 10 0 1#\n";
const Parts two_bodies = {{0, 1, 2, 3}, {4, 5, 6, 7}};

TEST(MeshParts, an_obj_has_its_bodies_however_their_faces_are_written) {
  for (const std::string faces :
       {"f 5 6 7 8", "f 5 6 7 \\\n 8", "f\\\n5 \\ \n\t6 7\\\n\\\n8", "f +5 +6 +7 +8",
        "f -4 -3 -2 -1", "f 5/1 6/1/1 7//1 8/", "f +5/+1 -3//-1 7 8", " \tf\t5  6\t7 8 \t",
        "f 5 6 7 8#9", "f 5 6 7 8 # 1 \\", "# f 1 5 \\\nf 5 6 7 8", "f 5 6 7\nf\nf 5 7 8",
        "f 5 6\nf 6 7\nf 8 7", "f 5 6 7\nf 8 8 6", "l 1 8\np 1 5\nvn 0 0 1\nf 5 6 7 8",
        "usemtl f\ns 1\nmtllib C:\\\nf 5 6 7 8"}) {
    for (const std::string name : {"g second", "o second", " \tg\tsecond # f 1 5", "g f 1 5"}) {
      const std::string second = name + "\n" + faces;
      expect_parts(MeshFormat::obj, eight_vertices + "f 1 2 3 4\n" + second, two_bodies);
      expect_parts(MeshFormat::obj, eight_vertices + "g first\nf 1 2 3 4\n" + second + "\n",
                   two_bodies);
    }
  }
  // Vertices may follow the faces that name them, or be between them.
  expect_parts(MeshFormat::obj, "f 1 2 3 4\ng second\nf 5 6 7 8\n" + eight_vertices, two_bodies);
  expect_parts(MeshFormat::obj,
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf -1 -2 -3 -4\n"
               "v 10 0 0\nv 11 0 0\nv 10 1 0\nv 10 0 1\no second\nf -1 -2 -3 -4\n",
               two_bodies);
}

TEST(MeshParts, the_corners_of_a_face_hang_together_however_few_they_are) {
  const std::string four = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  expect_parts(MeshFormat::obj, four + "f 2\n", {{1}});
  expect_parts(MeshFormat::obj, four + "f 1 3\n", {{0, 2}});
  expect_parts(MeshFormat::obj, four + "f 1 3\ng a\nf 2\n", {{0, 2}, {1}});
  // Without any face all vertices are one.
  expect_parts(MeshFormat::obj, four + "l 1 2\nf\n", {});
}

TEST(MeshParts, are_read_from_files) {
  const TemporaryFile obj("parts.OBJ", eight_vertices + "f 1 2 3 4\ng second\nf 5 6 7 \\\n8\n");
  const TemporaryFile stl("parts.Stl", "solid\nfacet normal 0 0 1\nvertex 1 2 3\nENDSOLID\n");
  EXPECT_EQ(read_mesh_parts(obj.path(), MeshSplit::none).parts, Parts{});
  for (const MeshSplit split : splits) {
    EXPECT_EQ(read_mesh_parts(obj.path(), split).parts, two_bodies);
    EXPECT_EQ(read_mesh_parts(stl.path(), split).parts, Parts{{0}});
  }
}

TEST(MeshParts, groups_of_an_obj_are_told_apart_by_all_that_their_names_say) {
  const std::string first = "f 1 2 3 4\n", second = "f 5 6 7 8\n";
  const auto groups = [&](const std::string& faces) {
    return mesh_parts(eight_vertices + faces, MeshFormat::obj, MeshSplit::groups).parts;
  };
  EXPECT_EQ(groups("g body 1\n" + first + "g body 2\n" + second), two_bodies);
  EXPECT_EQ(groups("g a\n" + first + "g\n" + second), two_bodies);
  EXPECT_EQ(groups("o a\ng x\n" + first + "o b\ng x\n" + second), two_bodies);
  EXPECT_EQ(groups("o a\ng x\n" + first + "o a\n" + second), two_bodies);
  // A name is one group, wherever it occurs; and no name is one, too.
  EXPECT_EQ(groups("g a b\nf 1 2 3\ng c\n" + second + "g\ta  b # c\nf 4\n"), two_bodies);
  EXPECT_EQ(groups("f 1 2 3\ng a\n" + second + "g\nf 4\n"), two_bodies);
  EXPECT_EQ(groups("o\nf 1 2 3\ng a\n" + second + "g\nf 4\n"), two_bodies);
  EXPECT_EQ(groups("g a\n" + first + "g a\n" + second), (Parts{{0, 1, 2, 3, 4, 5, 6, 7}}));
}

TEST(MeshParts, faces_whose_corners_are_not_there_are_refused_as_without_parts) {
  for (const MeshSplit split : {MeshSplit::none, MeshSplit::groups, MeshSplit::components}) {
    const auto obj = [&](const std::string& text) {
      return complaint("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + text, MeshFormat::obj, split);
    };
    EXPECT_EQ(obj("f 1 2 3 9\n"),
              "line 4: a face names vertex 9, but the file has 3 vertices (is it cut off?)");
    EXPECT_EQ(obj("f 1 2 3\ng a\nf 1 2 \\\n4294967297\n"),
              "line 6: a face names vertex 4294967297, but the file has 3 vertices (is it cut "
              "off?)");
    EXPECT_EQ(obj("f 1 2 3 -4\n"),
              "line 4: a face names vertex -4, but there are 3 vertices above it");
    for (const std::string word : {"x", "0", "3x", "1.0", "1e0", "/1", "+-1", "3\f"})
      EXPECT_EQ(obj("f 1 2 " + word + "\n"),
                "line 4: a face must name its vertices by whole numbers, from 1 or -1 on")
          << word;
    EXPECT_EQ(obj("f 1 2 3 \\"), "line 4: is cut off: no line follows its \"\\\"");
  }
}

/// A facet of a text STL with these corners, and two that share an edge.
std::string facet(const std::vector<std::string>& corners) {
  std::string text = "facet normal 0 0 1\nouter loop\n";
  for (const std::string& corner : corners) text += "vertex " + corner + "\n";
  return text + "endloop\nendfacet\n";
}
const std::string two_facets =
    facet({"0 0 0", "1 0 0", "0 1 0"}) + facet({"1 0 0", "0 1 0", "0 0 1"});
const std::string far_facet = facet({"10 0 0", "1.1e1 0 0", "+10 1 0"});
const Parts six_and_three = {{0, 1, 2, 3, 4, 5}, {6, 7, 8}};

TEST(MeshParts, a_text_stl_has_its_solids_however_they_are_written) {
  for (const std::string name : {"", " b", " facet endsolid 3 solid", "\tb # solid"}) {
    for (const std::string end : {"endsolid", "end solid", "END\tSOLID", "EndSolid \t"}) {
      const std::string text = "solid a\n" + two_facets + end + name + "\nsolid" + name + "\n" +
                               far_facet + end + name + "\n";
      std::string capitals = text, line = text, indented;
      for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      std::ranges::replace(line, '\n', ' ');
      for (const char c : "\n" + text)
        indented += c == '\n' ? "\n # endsolid facet\n\t " : std::string(1, c);
      for (const std::string& written : {text, capitals, indented})
        expect_parts(MeshFormat::stl, written, six_and_three);
      // On one line a # would hide the rest.
      if (name.find('#') == std::string::npos) expect_parts(MeshFormat::stl, line, six_and_three);
    }
  }
  // Solids of one name are two, and one without facets is none.
  expect_parts(MeshFormat::stl,
               "solid a\n" + two_facets + "endsolid a\nsolid\nendsolid\nmade by hand\nsolid a\n" +
                   far_facet + "endsolid a\n\x1a",
               six_and_three);
}

// Three corners each were once a facet, wherever the facets began.
TEST(MeshParts, facets_of_a_text_stl_end_where_the_file_says) {
  const std::string four = facet({"0 0 0", "1 0 0", "1 1 0", "0 1 0"}), one = facet({"5 5 5"});
  const Parts expected = {{0, 1, 2, 3}, {4, 5, 6}, {7}};
  const auto solid = [](const std::string& facets) { return "solid\n" + facets + "endsolid\n"; };
  expect_parts(MeshFormat::stl, solid(four) + solid(far_facet) + solid(one), expected);
  EXPECT_EQ(mesh_parts(solid(four + far_facet + one), MeshFormat::stl, MeshSplit::components).parts,
            expected);
  expect_parts(MeshFormat::stl, solid("vertex 1 2 3\n") + solid("vertex 4 5 6\nvertex 7 8 9\n"),
               {{0}, {1, 2}});
}

TEST(MeshParts, the_header_of_a_binary_stl_is_no_text) {
  std::string bytes = binary_stl({0, 0, 0, 1, 0, 0, 0, 1, 0}) +
                      binary_stl({10, 0, 0, 11, 0, 0, 10, 1, 0}).substr(84);
  const std::string header = "solid\nfacet\nendsolid\nfacet\n";
  bytes.replace(0, header.size(), header);
  bytes[80] = '\2';
  EXPECT_EQ(mesh_parts(bytes, MeshFormat::stl, MeshSplit::groups).parts,
            (Parts{{0, 1, 2, 3, 4, 5}}));
  EXPECT_EQ(mesh_parts(bytes, MeshFormat::stl, MeshSplit::components).parts,
            (Parts{{0, 1, 2}, {3, 4, 5}}));
}

TEST(MeshParts, files_cut_off_anywhere_are_refused_as_without_parts_or_lose_no_vertex) {
  const std::string obj = "\xef\xbb\xbf" + eight_vertices + "f 1 +2 \\\n3 4\r\ng 2\rf -4/1 6 7 8";
  const std::string stl =
      "SOLID\r" + two_facets + "endsolid\n# x\nsolid b\r\n" + far_facet + "END SOLID";
  const auto check = [&](MeshFormat format, const std::string& text) {
    int refused = 0;
    for (std::size_t length = 0; length <= text.size(); ++length) {
      const std::string_view file = std::string_view(text).substr(0, length);
      const std::string message = complaint(file, format);
      refused += !message.empty();
      for (const MeshSplit split : splits) {
        EXPECT_EQ(complaint(file, format, split), message) << length;
        if (!message.empty()) continue;
        const MeshParts mesh = mesh_parts(file, format, split);
        EXPECT_EQ(mesh.vertices, mesh_vertices(file, format)) << length;
        std::size_t held = 0;
        for (const std::vector<std::uint32_t>& part : mesh.parts) held += part.size();
        // In a text STL each vertex is a facet's.
        EXPECT_EQ(held == mesh.vertices.size(), format == MeshFormat::stl || length == text.size())
            << length;
      }
    }
    return refused;
  };
  EXPECT_GT(check(MeshFormat::obj, obj), 20);
  EXPECT_LT(check(MeshFormat::obj, obj), 100);
  EXPECT_GT(check(MeshFormat::stl, stl), 100);
}

}  // namespace
}  // namespace minkray
