// SPDX-License-Identifier: MIT
// Files that are made to crash, stall or fill the memory of who reads them.
#include <gtest/gtest.h>

#include <fstream>

#include "renderer/import/xml.h"
#include "tests/renderer/import/imports.h"
#include "tests/support/program.h"

namespace minkray {
namespace {

TEST(HostileXml, is_refused_with_a_reason) {
  const std::string bomb = R"(<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;">]>
    <robot name="&b;"/>)";
  EXPECT_NE(mistakes_of(bomb).find("declares entities"), std::string::npos);
  EXPECT_NE(mistakes_of("<robot").find("no XML"), std::string::npos);
  EXPECT_NE(mistakes_of("").find("no XML"), std::string::npos);
  EXPECT_NE(mistakes_of("<house/>").find("must be <mujoco>"), std::string::npos);
  std::string many(3'000'000, '<');
  EXPECT_NE(mistakes_of(many).find("elements"), std::string::npos);
  std::string deep = "<mujoco><worldbody>";
  for (int i = 0; i < 100000; ++i) deep += "<body>";
  EXPECT_NE(mistakes_of(deep).find("nested too deeply"), std::string::npos);
  EXPECT_NE(
      mistakes_of("<robot><link name='a'/><link name='b'/><joint name='1' type='fixed'><parent "
                  "link='a'/><child link='b'/></joint><joint name='2' type='fixed'><parent "
                  "link='b'/><child link='a'/></joint></robot>")
          .find("in a circle"),
      std::string::npos);
}

TEST(HostileXml, a_chain_of_a_hundred_thousand_joints_is_read) {
  constexpr int count = 100000;
  std::string text = "<robot name='chain'><link name='0'/>";
  for (int i = 1; i <= count; ++i) {
    const std::string here = std::to_string(i), before = std::to_string(i - 1);
    text += "<link name='" + here + "'/><joint name='j" + here +
            "' type='revolute'><origin xyz='1 0 0'/><parent link='" + before + "'/><child link='" +
            here + "'/></joint>";
  }
  text += "</robot>";
  Mistakes mistakes("chain.urdf");
  const std::optional<Model> model = parse_model(text, "chain.urdf", {}, mistakes);
  ASSERT_TRUE(model) << mistakes.text();
  EXPECT_EQ(link_poses(*model).back().translation, Vec3<double>(count, 0, 0));
}

TEST(HostileXml, files_that_include_each_other_and_large_files_are_refused) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
  };
  write("a.xml", "<mujoco><include file='b.xml'/></mujoco>");
  write("b.xml", "<mujoco><include file='a.xml'/></mujoco>");
  Mistakes circle(folder / "a.xml");
  EXPECT_FALSE(load_model(folder / "a.xml", {}, circle));
  EXPECT_NE(circle.text().find("included twice"), std::string::npos) << circle.text();
  write("large.xml", std::string(most_xml_bytes + 1, ' '));
  Mistakes large(folder / "large.xml");
  EXPECT_FALSE(load_model(folder / "large.xml", {}, large));
}

}  // namespace
}  // namespace minkray
