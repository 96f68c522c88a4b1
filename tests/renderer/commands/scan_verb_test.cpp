// SPDX-License-Identifier: MIT
// minkray scan as its users meet it: every output holds the same numbers, sensors ride on robots.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "renderer/io/exr.h"
#include "renderer/io/read_image.h"
#include "renderer/json/json.h"
#include "tests/support/expect_exit.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

/// A ball and a plane before a pinhole camera, and a lidar that looks around.
class ScanVerb : public ::testing::Test {
 protected:
  ScanVerb() {
    std::ofstream(folder_ / "r.urdf") << R"(<robot name="r"><link name="base"/>
      <link name="head"><collision><origin xyz="0 0 0"/><geometry><sphere radius="0.1"/></geometry>
      </collision></link>
      <link name="ball"><visual name="target"><geometry><sphere radius="1"/></geometry></visual>
      </link>
      <joint name="neck" type="revolute"><parent link="base"/><child link="head"/>
        <origin xyz="0 0 3"/><axis xyz="0 0 1"/></joint>
      <joint name="far" type="fixed"><parent link="base"/><child link="ball"/>
        <origin xyz="5 0 3"/></joint></robot>)";
    std::ofstream(folder_ / "k.json")
        << R"({"fx": 20, "fy": 20, "cx": 8, "cy": 6, "width": 17, "height": 13})";
  }

  ProgramOutcome scan(const std::string& arguments) {
    return run_minkray(folder_, "scan " + arguments);
  }
  std::string text(const std::string& name) { return text_of_file(folder_ / name); }

  TemporaryFolder folder_;
};

struct ScanRow {
  double t = 0, distance = 0;
  std::array<double, 3> point = {}, normal = {};
  int object = 0;
  int status = 0;
  double time = 0;
};

/// The records of a .npy file as they are laid out: 8 + 8 + 24 + 24 + 4 + 8 + 8 + 1 + 8 + 8 + 8
/// bytes.
std::vector<ScanRow> scan_rows(const std::string& bytes) {
  std::vector<ScanRow> rows;
  for (std::size_t at = bytes.find('\n') + 1; at + 109 <= bytes.size(); at += 109) {
    ScanRow row;
    std::memcpy(&row.t, bytes.data() + at, 8);
    std::memcpy(&row.distance, bytes.data() + at + 8, 8);
    std::memcpy(row.point.data(), bytes.data() + at + 16, 24);
    std::memcpy(row.normal.data(), bytes.data() + at + 40, 24);
    std::memcpy(&row.object, bytes.data() + at + 64, 4);
    row.status = bytes[at + 84];
    std::memcpy(&row.time, bytes.data() + at + 101, 8);
    rows.push_back(row);
  }
  return rows;
}

TEST_F(ScanVerb, every_output_holds_the_same_numbers) {
  // The camera looks along x: its z is the robot's x, its y points down.
  const ProgramOutcome outcome = scan(
      "r.urdf --pinhole k.json --pose 0,0,3,-0.5,0.5,-0.5,0.5 -q --ids ids.json"
      " -o a.npy -o a.csv -o a.pcd -o a.ply -o a.exr -o a.png");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<ScanRow> rows = scan_rows(text("a.npy"));
  ASSERT_EQ(rows.size(), 17u * 13u);
  std::vector<ScanRow> points;
  for (const ScanRow& row : rows) {
    if (row.object < 0) {
      EXPECT_EQ(row.t, std::numeric_limits<double>::infinity());
      continue;
    }
    points.push_back(row);
    const Vec3<double> point(row.point[0], row.point[1], row.point[2]);
    const Vec3<double> normal(row.normal[0], row.normal[1], row.normal[2]);
    // On the ball, or on the head that the camera is inside of.
    if (row.status == 0) {
      EXPECT_NEAR((point - Vec3<double>(5, 0, 3)).norm(), 1, 1e-12);
      EXPECT_LT((normal - (point - Vec3<double>(5, 0, 3))).norm(), 1e-12);
      EXPECT_NEAR(row.distance, (point - Vec3<double>(0, 0, 3)).norm(), 1e-12);
      EXPECT_NEAR(row.t, point.x(), 1e-12);  // the depth
    }
  }
  EXPECT_GT(points.size(), 20u);

  // CSV: the same doubles to the last digit.
  std::istringstream csv(text("a.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_TRUE(line.starts_with("ray,echo,t,distance,x,y,z"));
  for (const ScanRow& row : rows) {
    ASSERT_TRUE(std::getline(csv, line));
    std::istringstream cells(line);
    std::vector<double> values;
    for (std::string cell; std::getline(cells, cell, ',');)
      values.push_back(std::strtod(cell.c_str(), nullptr));
    ASSERT_EQ(values.size(), 17u);
    EXPECT_EQ(values[2], row.t);
    EXPECT_EQ(values[3], row.distance);
    if (row.object >= 0) {
      EXPECT_EQ(values[5], row.point[1]);
      EXPECT_EQ(values[8], row.normal[1]);
    }
    EXPECT_EQ(values[10], row.object);
    EXPECT_EQ(values[13], row.status);
    EXPECT_EQ(values[16], row.time);
  }

  // PCD and PLY: the points that were met, as floats.
  for (const auto& [name, last] :
       {std::pair{"a.pcd", "DATA binary\n"}, {"a.ply", "end_header\n"}}) {
    const std::string bytes = text(name);
    const std::size_t begin = bytes.find(last) + std::strlen(last);
    ASSERT_EQ(bytes.size() - begin, 32 * points.size()) << name;
    for (std::size_t i = 0; i < points.size(); ++i) {
      float numbers[6];
      int object = 0;
      std::memcpy(numbers, bytes.data() + begin + 32 * i, 24);
      std::memcpy(&object, bytes.data() + begin + 32 * i + 28, 4);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(numbers[k], static_cast<float>(points[i].point[k]));
        EXPECT_EQ(numbers[3 + k], static_cast<float>(points[i].normal[k]));
      }
      EXPECT_EQ(object, points[i].object);
    }
  }

  // EXR: planes of floats and of whole numbers; PNG: millimetres.
  const ExrImage exr = read_exr(folder_ / "a.exr");
  const auto floats = [&](const char* plane) {
    return std::get<std::vector<float>>(exr.find(plane)->values);
  };
  const auto naturals = [&](const char* plane) {
    return std::get<std::vector<std::uint32_t>>(exr.find(plane)->values);
  };
  ASSERT_EQ(exr.window.width(), 17);
  const std::string png = text("a.png");
  EXPECT_EQ(png.substr(16, 10), std::string("\0\0\0\x11\0\0\0\x0d\x10\0", 10));  // 16 bits, grey
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(floats("distance")[i], static_cast<float>(rows[i].distance));
    EXPECT_EQ(naturals("object")[i], static_cast<std::uint32_t>(rows[i].object + 1));
    EXPECT_EQ(naturals("status")[i], static_cast<std::uint32_t>(rows[i].status));
    if (rows[i].object >= 0) {
      EXPECT_EQ(floats("point.X")[i], static_cast<float>(rows[i].point[0]));
    }
  }
  const Json ids = Json::parse(text("ids.json"));
  // The head has no visual, and others have: it is not shown.
  ASSERT_EQ(ids.size(), 1u);
  EXPECT_EQ(ids[0]["name"].get<std::string>(), "target");
  EXPECT_EQ(ids[0]["object"].get<int>(), 0);
}

TEST_F(ScanVerb, a_sensor_on_a_link_goes_where_the_joints_bring_it) {
  std::ofstream(folder_ / "one.csv") << "time,azimuth,elevation\n0,0,0\n1,0,0\n2,0,0\n";
  std::ofstream(folder_ / "rows.json")
      << R"([{"time": 0, "neck": 0}, {"time": 2, "neck": 1.5707963267948966}])";
  // From outside of the head, which faces the ball, then past it, then along y.
  const ProgramOutcome outcome =
      scan("r.urdf --joints rows.json --pattern one.csv --on head --pose 0.5,0,0 -o a.npy -q");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<ScanRow> rows = scan_rows(text("a.npy"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_NEAR(rows[0].t, 3.5, 1e-12);
  EXPECT_EQ(rows[1].object, -1);
  EXPECT_EQ(rows[2].object, -1);
  expect_exit(2, scan("r.urdf --pattern one.csv --on haed -o a.npy"), {"did you mean \"head\""});
}

TEST_F(ScanVerb, a_path_moves_the_sensor) {
  std::ofstream(folder_ / "one.csv") << "time,azimuth,elevation\n0,0,0\n1,0,0\n2,0,0\n";
  std::ofstream(folder_ / "path.csv")
      << "time,x,y,z,qx,qy,qz,qw\n0,0,0,3,0,0,0,1\n2,2,0,3,0,0,0,2\n";
  const ProgramOutcome outcome =
      scan("r.urdf --pattern one.csv --path path.csv --pose 0.2,0,0 -o a.npy -q");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<ScanRow> rows = scan_rows(text("a.npy"));
  EXPECT_NEAR(rows[0].t, 3.8, 1e-12);
  EXPECT_NEAR(rows[1].t, 2.8, 1e-12);
  EXPECT_NEAR(rows[2].t, 1.8, 1e-12);
  for (const char* wrong :
       {"time,x,y\n0,0,0\n", "time,x,y,z\n1,0,0,0\n0,0,0,0\n", "time,x,y,z\n",
        "time,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,0\n", "time,x,y,z\n0,nan,0,0\n"}) {
    std::ofstream(folder_ / "path.csv") << wrong;
    EXPECT_EQ(scan("r.urdf --pattern one.csv --path path.csv -o a.npy").exit_code, 3) << wrong;
  }
}

TEST_F(ScanVerb, rays_of_length_zero_and_wrong_arrays_are_answered_or_refused) {
  const auto array = [](const std::string& descr, const std::string& shape,
                        const std::vector<double>& numbers, const char* by_columns = "False") {
    std::string header =
        "{'descr': '" + descr + "', 'fortran_order': " + by_columns + ", 'shape': " + shape + ", }";
    header.resize(117, ' ');
    header += '\n';
    std::string bytes("\x93NUMPY\1\0v\0", 10);
    bytes += header;
    bytes.append(reinterpret_cast<const char*>(numbers.data()), 8 * numbers.size());
    return bytes;
  };
  const auto write = [&](const std::string& bytes) {
    std::ofstream(folder_ / "rays.npy", std::ios::binary) << bytes;
  };
  write(array("<f8", "(2, 6)", {0, 0, 9, 0, 0, 0, 5, 0, 3, 0, 0, 0}));
  const ProgramOutcome outcome = scan("r.urdf --rays rays.npy -o a.npy --returns 3 -q");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<ScanRow> rows = scan_rows(text("a.npy"));
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0].status, 1);
  EXPECT_EQ(rows[3].status, 2);
  EXPECT_EQ(rows[3].distance, 0);
  // NumPy writes arrays that were transposed column by column: the rays are the same.
  const std::string once = text("a.npy");
  write(array("<f8", "(2, 6)", {0, 5, 0, 0, 9, 3, 0, 0, 0, 0, 0, 0}, "True"));
  ASSERT_EQ(scan("r.urdf --rays rays.npy -o a.npy --returns 3 -q").exit_code, 0);
  EXPECT_EQ(text("a.npy"), once);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::string& bytes :
       {array("<f8", "(1, 6)", {nan, 0, 0, 0, 0, 1}), array("<f8", "(2, 6)", {0, 0, 0, 0, 0, 1}),
        array(">f8", "(1, 6)", {0, 0, 0, 0, 0, 1}), array("<i8", "(1, 6)", {0, 0, 0, 0, 0, 1}),
        array("<f8", "(6,)", {0, 0, 0, 0, 0, 1}), array("<f8", "(99999999999999999999, 6)", {}),
        array("<f8", "(4611686018427387905, 6)", {0, 0, 0, 0, 0, 1}), array("<f8", "", {}),
        std::string("\x93NUMPY\1\0\xff\xff", 10), std::string("\x93NUMPY"), std::string()}) {
    write(bytes);
    EXPECT_EQ(scan("r.urdf --rays rays.npy -o a.npy").exit_code, 3) << bytes.substr(0, 90);
  }
  // Too many rays are rejected before memory ends.
  expect_exit(2, scan("r.urdf --pattern spinning:65536x65536 -o a.npy"));
  // No rays at all are an array of none.
  write(array("<f8", "(0, 6)", {}));
  expect_exit(0, scan("r.urdf --rays rays.npy -o a.npy -q"));
}

TEST_F(ScanVerb, a_sensor_that_stands_in_a_body_is_told_of) {
  const std::string pattern = "r.urdf --pattern spinning:4x8 -o a.npy";
  const ProgramOutcome within = scan(pattern + " --pose 5,0,3 --returns 2");
  EXPECT_EQ(within.exit_code, 0);
  EXPECT_TRUE(has(within.err, "32 of 32 rays start inside a body"));
  EXPECT_FALSE(has(scan(pattern + " --pose 2,0,3").err, "within a body"));
}

TEST_F(ScanVerb, a_pattern_without_its_numbers_is_told_which_it_wants) {
  expect_exit(2, scan("r.urdf --pattern spinning -o a.npy"), {"spinning:CHANNELSxSTEPS"});
}

/// Scene files had to have what pictures need.
TEST_F(ScanVerb, a_scene_that_is_only_scanned_needs_no_camera_and_no_lights) {
  std::ofstream(folder_ / "bare.json") << R"({"version": 1,
    "materials": [{"name": "grey", "type": "lambert", "color": [0.25, 0.5, 0.75]}],
    "objects": [{"name": "wall", "material": "grey",
                 "shape": {"type": "plane", "normal": [-1, 0, 0], "offset": -4}}]})";
  const ProgramOutcome outcome =
      scan("bare.json --pattern vlp-16:4 --range 1,100 -q -o a.npy -o a.las -o a.mcap");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(scan_rows(text("a.npy")).size(), 64u);
  EXPECT_EQ(text("a.las").substr(0, 4), "LASF");
  expect_exit(3, run_minkray(folder_, "render bare.json -o a.png"), {"/camera"});
}

TEST_F(ScanVerb, wrong_numbers_of_sensors_are_told_before_anything_is_written) {
  std::ofstream(folder_ / "a.npy") << "kept";
  for (const auto& [words, message] :
       {std::pair{"--pattern VLP-16 --range 2,1", "--range: must be 0 <= MIN < MAX (got 2,1)"},
        {"--pattern VLP-16 --range 2", "--range: must be"},
        {"--pattern VLP-16 --noise 1,2,-3", "--noise: must be >= 0"},
        {"--pattern VLP-16 --echo second", "--echo"},
        {"--pattern VLP-16 --divergence -1", "--divergence"},
        {"--pattern VLP-16 --beam-rays 0", "--beam-rays"},
        {"--pattern VLP-16 --start -1 -o a.mcap", "--start: must be >= 0 for a.mcap"},
        {"--pattern Mid-360 -o a.json", "an image needs rays in rows and columns (got a.json)"},
        {"--pattern HDL-32 ", "known here: spinning:CHANNELSxSTEPS, VLP-16"}}) {
    const ProgramOutcome outcome = scan("r.urdf -o a.npy " + std::string(words));
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_TRUE(has(outcome.err, message));
  }
  EXPECT_EQ(text("a.npy"), "kept");
}

TEST_F(ScanVerb, pixels_without_a_ray_are_counted) {
  std::ofstream(folder_ / "fold.json")
      << R"({"fx": 4, "fy": 4, "cx": 8, "cy": 6, "width": 17, "height": 13, "k1": -0.3})";
  const ProgramOutcome outcome = scan("r.urdf --pinhole fold.json --pose 0,0,1 -q -o a.npy");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<ScanRow> rows = scan_rows(text("a.npy"));
  const auto missing = std::ranges::count(rows, 5, &ScanRow::status);
  EXPECT_GT(missing, 0);
  EXPECT_TRUE(has(outcome.err, std::to_string(missing) + " of 221 pixels have no ray"));
}

}  // namespace
}  // namespace minkray
