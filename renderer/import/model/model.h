// SPDX-License-Identifier: MIT
// Common model of robots' files: a tree of links, the joints between them, and their shapes. Each
// format is read into a Model, from which a scene is made. Lengths as in the file (metres), angles
// in radians.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "core/math/affine.h"
#include "core/mesh/triangle_mesh.h"
#include "core/shape/shape.h"

namespace minkray {

struct MeshAttributes;
struct MeshMaterial;

enum class JointKind : unsigned char { fixed, hinge, slide, ball, free, planar };

/// Count of numbers that place a joint: a ball's are a quaternion w, x, y, z; a free joint's a
/// position and a quaternion; a planar joint's two lengths and an angle.
std::size_t width_of(JointKind kind);
std::string_view name_of(JointKind kind);

struct Mimic {
  std::string joint;
  double multiplier = 1, offset = 0;
};

struct ModelJoint {
  std::string name;
  JointKind kind = JointKind::fixed;
  Vec3<double> axis = {0, 0, 1};               ///< of unit length, in the link's frame
  Vec3<double> anchor = Vec3<double>::Zero();  ///< a point of the axis, in the link's frame
  double reference = 0;                        ///< the value at the link's rest pose
  std::optional<std::array<double, 2>> limits = {};
  std::optional<Mimic> mimic = {};
  std::vector<double> value = {};  ///< empty: at rest
};

struct ModelLink {
  std::string name;
  int parent = -1;      ///< the parent's index, less than the link's own; -1: the world
  Affine<double> rest;  ///< in the parent's frame, its joints at rest
  std::vector<ModelJoint> joints = {};
};

/// Contact shape of a geom that rays meet as a mesh: in MuJoCo meshes touch as their hulls, and
/// planes that are drawn as rectangles are unbounded.
enum class Touch : unsigned char { as_seen, as_hull, as_half_space };

struct ModelGeom {
  std::string name;
  std::string kind;  ///< in the format's words: "capsule", "mesh", "plane"
  int link = -1;     ///< -1: the world
  Affine<double> pose;
  /// Geometry: a shape, a mesh, or with neither the half-space under z = 0.
  std::optional<Shape> shape = {};
  std::shared_ptr<const TriangleMesh> mesh = {};
  Touch touches = Touch::as_seen;                         ///< contact shape of a mesh
  std::shared_ptr<const MeshAttributes> attributes = {};  ///< of the mesh, if it has any
  /// Materials by the attributes' numbers; null: all of it has the colour.
  std::shared_ptr<const std::vector<MeshMaterial>> materials = {};
  std::array<double, 4> rgba = {0.7, 0.7, 0.7, 1};
  /// Alpha that decides if rays meet the geom; unset: that of rgba.
  std::optional<double> alpha_for_rays = {};
  bool collides = true, is_seen = true;

  /// For rays; for contact.
  bool is_half_space() const { return !shape && !mesh; }
  bool touches_as_half_space() const { return is_half_space() || touches == Touch::as_half_space; }
};

/// A mesh file, at one scale.
struct ModelMesh {
  std::string file;
  std::size_t vertices = 0;
  double diameter = 0;  ///< the longest side of its box
  /// Shown form of each part: a surface, or a hull and its vertices.
  struct Part {
    std::shared_ptr<const TriangleMesh> surface = {};
    std::optional<PointCloud> hull = {};
    std::vector<Vec3<double>> vertices = {};
  };
  std::vector<Part> parts;
};

/// Contents of a file that are ignored, and why.
struct PassedOver {
  std::string what, why;
  std::size_t count = 1;
};

struct ModelKeyframe {
  std::string name;            ///< may be empty
  std::vector<double> values;  ///< of all joints in their order; empty: all are at rest
};

/// Few lines can show a mesh of many parts again and again.
inline constexpr std::size_t most_geoms = 1'000'000;

struct Model {
  std::string format, name;
  std::vector<ModelLink> links;
  std::vector<ModelGeom> geoms;
  std::vector<ModelMesh> meshes;
  std::vector<ModelKeyframe> keyframes;
  std::vector<PassedOver> passed_over;
  std::string hash;                          ///< of all that was read
  std::vector<std::filesystem::path> files;  ///< that were read

  void pass_over(const std::string& what, const std::string& why, std::size_t count = 1);
};

/// Motion of the link for a joint's value, in the link's frame at rest; not for free joints, whose
/// values are the link's pose in the world.
Affine<double> motion_of(const ModelJoint& joint);

/// Two directions of a plane with that normal, along which a planar joint slides.
std::array<Vec3<double>, 2> directions_across(const Vec3<double>& normal);

/// Poses of the links in the world for the joints' values.
std::vector<Affine<double>> link_poses(const Model& model);

/// The joints that have a value, by name: the first one if several have the same name. Valid as
/// long as the model's links and names.
using JointsByName = std::unordered_map<std::string_view, ModelJoint*>;
JointsByName joints_by_name(Model& model);

/// Returns the index of the link with this name, or -1 if no link has it.
int find_link(const Model& model, std::string_view name);

/// The joint of that name, or null.
ModelJoint* find_joint(Model& model, const std::string& name);

/// The joint's numbers; those at which the link rests if none are set.
std::vector<double> value_of(const ModelLink& link, const ModelJoint& joint);

/// The keyframe of that name, or of that number, counted from 0; or null.
const ModelKeyframe* find_keyframe(const Model& model, const std::string& name);

/// Names of keyframes, or numbers where they have none.
std::vector<std::string> keyframe_names(const Model& model);

/// Gives all joints the values of a keyframe, as far as they reach.
void set_values(Model& model, const std::vector<double>& values);

/// A joint may mimic one that mimics another one, and so on.
inline constexpr std::size_t longest_mimicry = 100;

/// Gives joints that mimic others their values. Answers the name of a joint that is not there, or
/// that mimics itself or through too many others; "" if there is none.
std::string follow_mimics(Model& model);

}  // namespace minkray
