// SPDX-License-Identifier: MIT
#include "tests/robots/hostile_files.h"

#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>

#include "tests/support/program.h"

namespace minkray {
namespace {

constexpr int read_it = 0, refused = 3;
constexpr int many = 100000;

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

std::string chain_of_joints() {
  std::string text = "<robot name='chain'><link name='0'/>";
  for (int i = 1; i <= many; ++i) {
    const std::string here = std::to_string(i), before = std::to_string(i - 1);
    text += "<link name='" + here +
            "'><visual><geometry><sphere radius='.4'/></geometry></visual></link><joint name='j" +
            here + "' type='revolute'><origin xyz='1 0 0'/><parent link='" + before +
            "'/><child link='" + here + "'/></joint>";
  }
  return text + "</robot>";
}

std::string doubling_nodes() {
  std::string nodes = "<node id='n0'/>";
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "<instance_node url='#n" + std::to_string(i - 1) + "'/>";
    nodes += "<node id='n" + std::to_string(i) + "'>" + before + before + "</node>";
  }
  return "<COLLADA><library_visual_scenes><visual_scene>" + nodes +
         "</visual_scene></library_visual_scenes></COLLADA>";
}

struct Case {
  const char *what, *file;
  int expected;
  std::function<std::string()> text;
};

/// Other files that the cases name.
void write_others(const TemporaryFolder& folder) {
  std::ofstream(folder / "b.xml") << "<mujoco><include file='cycle.xml'/></mujoco>";
  const std::string filler(std::size_t{4} << 20, 'x');
  std::ofstream(folder / "b.sdf")
      << "<sdf version='1.6'><model name='m'><include><uri>twice.sdf</uri></include><include><uri>"
         "twice.sdf</uri></include><plugin>"
      << filler << "</plugin></model></sdf>";
  std::ofstream(folder / "doubling.dae") << doubling_nodes();
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"entities that grow a thousand million times", "bomb.urdf", refused,
       [] {
         std::string text = "<!DOCTYPE r [<!ENTITY a0 \"ha\">";
         for (int i = 1; i <= 30; ++i)
           text += "<!ENTITY a" + std::to_string(i) + " \"" +
                   repeated("&a" + std::to_string(i - 1) + ";", 10) + "\">";
         return text + "]><robot name='&a30;'/>";
       }},
      {"100 MB of elements", "large.urdf", refused,
       [] { return "<robot>" + repeated("<link name='a'/>", 6'500'000) + "</robot>"; }},
      {"30 MB of elements", "medium.urdf", refused,
       [] { return "<robot>" + repeated("<a/>", 7'500'000) + "</robot>"; }},
      {"one element of 10^6 attributes", "attributes.xml", refused,
       [] {
         std::string text = "<mujoco><worldbody><geom";
         for (int i = 0; i < 1'000'000; ++i) text += " a" + std::to_string(i) + "='1'";
         return text + "/></worldbody></mujoco>";
       }},
      {"files that include each other", "cycle.xml", refused,
       [] { return "<mujoco><include file='b.xml'/></mujoco>"; }},
      {"models that include each other twice", "twice.sdf", refused,
       [] {
         return "<sdf version='1.6'><model name='m'><include><uri>b.sdf</uri></include><include>"
                "<uri>b.sdf</uri></include></model></sdf>";
       }},
      {"NaN, infinity, 1e999", "numbers.urdf", refused,
       [] {
         return "<robot name='r'><link name='a'><visual><origin xyz='nan inf 1e999'/><geometry>"
                "<sphere radius='nan'/></geometry></visual></link></robot>";
       }},
      {"joints between bodies that are not there", "bodies.urdf", refused,
       [] {
         return "<robot name='r'><link name='a'/>" +
                repeated("<joint name='j' type='fixed'><parent link='x'/><child link='y'/></joint>",
                         many) +
                "</robot>";
       }},
      {"10^5 joints in a chain, a ball on each", "chain.urdf", read_it, chain_of_joints},
      {"10^5 bodies in each other", "deep.xml", refused,
       [] { return "<mujoco><worldbody>" + repeated("<body>", many); }},
      {"nodes of a mesh that show each other 2^60 times", "nodes.urdf", refused,
       [] {
         return "<robot name='r'><link name='a'><visual><geometry><mesh filename='doubling.dae'/>"
                "</geometry></visual></link></robot>";
       }},
      {"glTF: nodes in a circle", "circle.gltf", refused,
       [] {
         return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                "nodes": [{"children": [1]}, {"children": [0]}]})";
       }},
      {"glTF: 10^5 meshes that read 10^5 points of zeros each", "accessors.gltf", refused,
       [] {
         std::string primitives, accessors;
         for (int i = 0; i < many; ++i) {
           const char* comma = i > 0 ? "," : "";
           primitives += comma + (R"({"attributes":{"POSITION":)" + std::to_string(i)) + "}}";
           accessors += std::string(comma) +
                        R"({"componentType":5120,"count":100000,"type":"VEC3","sparse":{"count":1,)"
                        R"("indices":{"bufferView":0,"componentType":5121},)"
                        R"("values":{"bufferView":0}}})";
         }
         return R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" +
                primitives + R"(]}],"accessors":[)" + accessors +
                R"(],"bufferViews":[{"buffer":0,"byteLength":3}],)"
                R"("buffers":[{"byteLength":3,"uri":"data:;base64,AAAA"}]})";
       }},
      {"glTF: 100 MB of brackets", "brackets.gltf", refused,
       [] { return repeated("[", 100'000'000); }},
  };
  return all;
}

}  // namespace

ProcessCost cost_of_minkray(const std::vector<std::string>& arguments) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const pid_t process = start_minkray(arguments);
  int status = 0;
  rusage usage = {};
  wait4(process, &status, 0, &usage);
  ProcessCost cost;
  cost.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  cost.megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  if (WIFEXITED(status)) cost.exit_code = WEXITSTATUS(status);
  return cost;
}

std::vector<HostileRow> hostile_files() {
  const TemporaryFolder folder;
  write_others(folder);
  std::vector<HostileRow> rows;
  for (const Case& one : cases()) {
    const std::string file = folder / one.file;
    std::ofstream(file) << one.text();
    const ProcessCost cost = cost_of_minkray({"info", file});
    rows.push_back({one.what, one.expected, cost.exit_code, cost.seconds, cost.megabytes});
    std::filesystem::remove(file);
  }
  return rows;
}

}  // namespace minkray
