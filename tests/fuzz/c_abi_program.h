// SPDX-License-Identifier: MIT
// A program of calls of the C interface that bytes describe, right ones and wrong ones, with a
// model of what there must be after each.
#pragma once

#include <deque>
#include <optional>

#include "tests/fuzz/bytes.h"
#include "tests/fuzz/c_abi_calls.h"

namespace minkray::fuzz {

/// An argument, and whether it can be.
template <class T>
struct Given {
  T value;
  Sure sure = Sure::right;
};

/// Number of calls that released the data of a support function.
struct Released {
  int times = 0;
};

/// Behaviour of a program's support function.
struct Support {
  double radius = 1;
  enum Kind { honest, not_a_number, fails, inside_out, changes } kind = honest;
  int calls = 0;
  Released* released = nullptr;
};

class CallProgram {
 public:
  explicit CallProgram(Bytes bytes) : bytes_(bytes), wild_(bytes_.byte() % 4 == 0) {}

  /// Makes the calls, releases everything, and returns a description of the first error.
  std::string run();

 private:
  struct HeldShape {
    minkray_shape shape;
    int owners = 1;
    bool is_custom = false;
  };
  struct HeldGroup {
    bool is_robot = false;
    bool has_particles = false;  ///< cannot be moved then
    std::uint32_t joints = 0;
    std::size_t numbers = 0;  ///< of all joints together
  };
  struct HeldScene {
    minkray_scene scene;
    bool is_held = true;
    Sure committed = Sure::wrong;
    std::uint32_t objects = 0, particles = 0;
    std::vector<HeldGroup> groups;
  };

  void step();

  // c_abi_arguments.cpp
  bool hostile() { return bytes_.byte() >= 248; }
  double number();
  Given<minkray_shape> shape();
  Given<minkray_scene> scene();
  HeldScene* model_of(minkray_scene scene);
  Given<const minkray_pose*> pose(bool required = false);
  Given<const minkray_options*> options();
  Given<std::vector<minkray_ray>> rays();
  void hold(minkray_shape made, bool is_custom);

  // c_abi_shapes.cpp
  void make_shape();
  void read_shape();
  void make_custom();
  void own_shape();
  void write_shape();
  void ask_shape();

  // c_abi_scenes.cpp
  void make_scene();
  void release_scene();
  void add_object();
  void add_half_space();
  void add_file();
  void move();
  void set_joint();
  void commit();
  void look();
  void check_sizes(HeldScene& of);

  // c_abi_rays.cpp
  void cast();
  void cast_at_one();
  void prove();
  void check_hits(const std::vector<minkray_ray>& rays, const Answers<minkray_hit>& hits,
                  std::uint32_t instances);

  // c_abi_pairs.cpp
  void distance();
  void impact();
  void clearance();
  void lidar();
  void picture();

  Bytes bytes_;
  bool wild_;  ///< numbers of any size: then answers may overflow
  Promises promises_;
  std::vector<HeldShape> shapes_;
  std::vector<HeldScene> scenes_;
  std::deque<Support> supports_;
  Released released_;
  // Targets of pointer arguments.
  minkray_pose pose_[2];
  int next_pose_ = 0;
  minkray_options options_;
};

}  // namespace minkray::fuzz
