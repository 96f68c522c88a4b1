// SPDX-License-Identifier: MIT
// Compares the links of URDF with a second way of computing their poses.
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "tests/renderer/import/imports.h"
#include "tests/support/dart_frames.h"
#include "tests/support/random.h"
#include "tests/support/robot_models.h"

namespace minkray {
namespace {

using Number = long double;
using Quaternion = Eigen::Quaternion<Number>;
using Vector = Eigen::Matrix<Number, 3, 1>;

/// A URDF's joints as regular expressions find them, and the links' frames by quaternions in long
/// double: shares nothing with the reader.
class SecondKinematics {
 public:
  explicit SecondKinematics(const std::string& file) {
    std::string text = text_of_file(file);
    text = std::regex_replace(text, std::regex("<!--[^]*?-->"), "");
    const std::regex joint("<joint\\s([^>]*[^/])>([^]*?)</joint>");
    for (std::sregex_iterator at(text.begin(), text.end(), joint), end; at != end; ++at) {
      const std::string head = " " + at->str(1), body = at->str(2);
      if (attribute(head, "type").empty()) continue;  // of a transmission
      Joint read;
      read.name = attribute(head, "name");
      read.type = attribute(head, "type");
      read.parent = attribute(element(body, "parent"), "link");
      const std::string child = attribute(element(body, "child"), "link");
      const std::string origin = element(body, "origin");
      read.xyz = vector(attribute(origin, "xyz"), Vector(0, 0, 0));
      read.rpy = vector(attribute(origin, "rpy"), Vector(0, 0, 0));
      read.axis = vector(attribute(element(body, "axis"), "xyz"), Vector(1, 0, 0)).normalized();
      if (!child.empty()) joints_[child] = read;
    }
  }

  std::size_t size() const { return joints_.size(); }

  void frame(const std::string& link, const std::map<std::string, double>& values, Vector& at,
             Quaternion& turned) const {
    const auto found = joints_.find(link);
    if (found == joints_.end()) {
      at.setZero();
      turned.setIdentity();
      return;
    }
    const Joint& joint = found->second;
    frame(joint.parent, values, at, turned);
    at += turned * joint.xyz;
    for (const int axis : {2, 1, 0})
      turned = turned * Quaternion(Eigen::AngleAxis<Number>(joint.rpy[axis], Vector::Unit(axis)));
    const auto value = values.find(joint.name);
    if (value == values.end()) return;
    if (joint.type == "prismatic")
      at += turned * Vector(Number(value->second) * joint.axis);
    else
      turned = turned * Quaternion(Eigen::AngleAxis<Number>(Number(value->second), joint.axis));
  }

 private:
  struct Joint {
    std::string name, type, parent;
    Vector xyz, rpy, axis;
  };
  static std::string element(const std::string& body, const std::string& name) {
    std::smatch match;
    return std::regex_search(body, match, std::regex("<" + name + "(\\s[^>]*)>")) ? match.str(1)
                                                                                  : "";
  }
  static std::string attribute(const std::string& text, const std::string& name) {
    std::smatch match;
    return std::regex_search(text, match, std::regex("\\s" + name + "\\s*=\\s*[\"']([^\"']*)"))
               ? match.str(1)
               : "";
  }
  static Vector vector(const std::string& text, const Vector& otherwise) {
    std::istringstream stream(text);
    double x = 0, y = 0, z = 0;
    return stream >> x >> y >> z ? Vector(x, y, z) : otherwise;
  }
  std::map<std::string, Joint> joints_;
};

TEST(Urdf, links_stand_where_a_second_way_in_long_double_puts_them) {
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  const std::string atlas = "simbody/TaskSpaceControl-Atlas/models/atlas_v4.urdf";
  for (const std::string& name : {atlas, std::string("dart/urdf/wam/wam.urdf"),
                                  std::string("dart/urdf/KR5/KR5 sixx R650.urdf"),
                                  std::string("dart/urdf/drchubo/drchubo.urdf")}) {
    const std::string file = (robot_models() / name).string();
    Mistakes mistakes(file);
    std::optional<Model> model = load_model(file, without_meshes(), mistakes);
    ASSERT_TRUE(model) << mistakes.text();
    const SecondKinematics second(file);
    ASSERT_GT(second.size(), 5u) << name;
    testing::Random random(5);
    double worst = 0;
    for (int state = 0; state < 100; ++state) {
      std::map<std::string, double> values;
      for (ModelLink& link : model->links)
        for (ModelJoint& joint : link.joints)
          if (width_of(joint.kind) == 1) {
            values[joint.name] = random.uniform(-3, 3);
            joint.value = {values[joint.name]};
          }
      const std::vector<Affine<double>> poses = link_poses(*model);
      for (std::size_t i = 0; i < poses.size(); ++i) {
        Vector at;
        Quaternion turned;
        second.frame(model->links[i].name, values, at, turned);
        const Mat3<double> rotation = turned.toRotationMatrix().cast<double>();
        worst = std::max({worst, (poses[i].translation - at.cast<double>()).norm(),
                          (poses[i].linear - rotation).cwiseAbs().maxCoeff()});
      }
    }
    EXPECT_LT(worst, 1e-12) << name;
  }
}

/// The turn of a free joint at rest had its numbers in another order.
TEST(Mjcf, links_stay_where_they_are_with_the_values_at_which_joints_rest) {
  Mistakes mistakes("robot.xml");
  std::optional<Model> model = parse_model(R"(<mujoco><worldbody>
  <body pos="1 2 3" quat=".1 .5 -.3 .8"><freejoint name="free"/><geom size=".1"/>
    <body pos="0 1 0" quat=".7 .1 .2 .3"><joint name="hinge" axis="1 2 3" ref=".5"/><geom size=".1"/>
      <body pos="1 0 0"><joint name="ball" type="ball" pos=".1 .2 .3"/><geom size=".1"/>
        <body pos="1 0 0"><joint name="slide" type="slide" axis="0 1 1" ref=".2"/><geom size=".1"/></body>
      </body>
    </body>
  </body></worldbody></mujoco>)",
                                           "robot.xml", {}, mistakes);
  ASSERT_TRUE(model) << mistakes.text();
  const std::vector<Affine<double>> before = link_poses(*model);
  for (ModelLink& link : model->links)
    for (ModelJoint& joint : link.joints) joint.value = value_of(link, joint);
  const std::vector<Affine<double>> after = link_poses(*model);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT((after[i].linear - before[i].linear).norm(), 1e-14) << model->links[i].name;
    EXPECT_LT((after[i].translation - before[i].translation).norm(), 1e-14);
  }
}

TEST(Urdf, links_stand_where_dart_puts_them) {
  if (!has_robot_models()) GTEST_SKIP() << "run scenes/fetch-models";
  for (const char* name : robots_beside_dart) {
    const auto errors = frames_beside_dart((robot_models() / name).string(), 100);
    if (!errors) GTEST_SKIP() << "python3-dartpy is not installed";
    EXPECT_EQ(errors->missing, "") << name;
    EXPECT_GT(errors->links, 6u) << name;
    EXPECT_EQ(errors->states, 100u) << name;
    EXPECT_LT(errors->worst, 1e-12) << name;
  }
}

}  // namespace
}  // namespace minkray
