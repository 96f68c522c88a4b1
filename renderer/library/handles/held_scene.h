// SPDX-License-Identifier: MIT
// Scene behind a handle: objects are added and moved, then committed, and rays see the last commit.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/world/world.h"
#include "renderer/import/import.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/custom_support.h"
#include "renderer/library/handles/handles.h"
#include "renderer/library/handles/held_shape.h"
#include "renderer/library/handles/pair_rules.h"
#include "renderer/library/handles/scene_use.h"
#include "renderer/scene/scene.h"

namespace minkray {

class SceneBodies;

/// One call changes it, or any number query it: see scene_use.h.
class HeldScene {
 public:
  /// Objects that came from one file.
  struct Group {
    std::uint32_t first = 0, count = 0;
    std::uint32_t first_in_scene = 0;     ///< among the objects of all files
    Affine<double> pose;                  ///< of all of them
    std::vector<Affine<double>> in_file;  ///< poses in the file's frame
    bool has_particles = false;           ///< particles have no poses of their own
    std::optional<Model> model;           ///< if it is a robot's
    ImportOptions options;
    std::vector<std::pair<std::string, std::size_t>> joints;  ///< that move: names and widths
  };

  std::uint32_t add(const HeldShape& shape, const Affine<double>& pose, const char* name);
  std::uint32_t add(const HalfSpaceBody<double>& half_space, const char* name);
  std::uint32_t add_file(const std::string& file, const ImportOptions& options,
                         const std::optional<Affine<double>>& pose);
  void set_pose(std::uint32_t object, const Affine<double>& pose);
  void set_group_pose(std::uint32_t group, const Affine<double>& pose);
  void set_joint(std::uint32_t group, const std::string& name, std::span<const double> values);
  void remove(std::uint32_t object);
  void commit();

  /// Number of objects ever added.
  std::uint32_t size() const { return size_; }
  const std::vector<ParticleSet>& particles() const { return scene_.particles; }
  /// Throws CallError if the number is that of no object, or of a removed one.
  void check_object(std::uint32_t number, const char* argument = "object") const;
  Affine<double> pose(std::uint32_t number) const;
  /// Throws CallError if the number is that of no group.
  const Group& group(std::uint32_t group) const;
  bool is_removed(std::uint32_t object) const {
    return !removed_.empty() && removed_.contains(object);
  }
  /// Value of a joint of the group.
  std::vector<double> joint_value(const Group& group, const std::string& name) const;
  /// The object's name, at a place where it stays as long as the scene.
  const char* name(std::uint32_t object) const;

  /// The scene as files describe it. Objects are written out: for pictures and proofs, not for
  /// rays.
  Scene whole() const;
  /// True if a file had a camera.
  bool has_camera() const { return has_camera_; }
  const std::vector<std::shared_ptr<const CustomSupport>>& customs() const { return customs_; }

  /// The world that rays are cast at. Throws CallError if the scene was not committed since it was
  /// changed, or if this is called from within the support function of a shape in it.
  const World& world() const;

  const PairRules& pair_rules() const { return pair_rules_; }
  /// To be changed. No commit is due for that.
  PairRules& changed_pair_rules() {
    bodies_.reset();
    return pair_rules_;
  }
  /// For queries on pairs; made by the first call after a change. Throws as world() does.
  const SceneBodies& bodies() const;
  /// Pose of an object or a particle.
  Affine<double> pose_of_any(std::uint32_t number) const;
  std::uint32_t groups() const { return static_cast<std::uint32_t>(groups_.size()); }

 private:
  /// Work of the next commit.
  enum class Due { nothing, refit, build };

  void check_room(std::size_t more) const;
  std::uint32_t grey();
  void keep_customs(const std::vector<std::shared_ptr<const CustomSupport>>& customs);
  void append(Scene&& from);
  std::uint32_t number_of_added(const char* name);
  /// The object with all data of its file; null if it is not from a file.
  const Object* of_file(std::uint32_t number) const;
  Object object(std::uint32_t number) const;
  const Instances& instances() const {
    return due_ == Due::build ? instances_ : world_.instances();
  }
  /// The objects' instances, to be built again.
  Instances& changed();
  void place(Group& group);
  void place(std::uint32_t number, Object& object, const Affine<double>& pose);
  void set_instance_pose(std::uint32_t number, const Affine<double>& pose);
  void show_instances(Instances& instances) const;

  // An object that is added to the scene is only an instance: its shape and pose are there. Names
  // and poses that instances do not hold are kept separately; so are objects of files.
  std::uint32_t size_ = 0;
  Instances instances_;  ///< of objects, while a build is due; else the world has them
  std::unordered_map<std::uint32_t, Affine<double>> poses_;
  Scene scene_;                        ///< contents of files
  std::optional<std::uint32_t> grey_;  ///< the material of what is added without one
  bool has_camera_ = false;            ///< and lights, of the first file that has them
  std::vector<Group> groups_;
  std::vector<std::shared_ptr<const CustomSupport>> customs_;  ///< each once
  std::unordered_set<const CustomSupport*> known_customs_;
  std::unordered_set<std::uint32_t> removed_;
  World world_;
  Due due_ = Due::build;

  PairRules pair_rules_;
  mutable std::mutex bodies_mutex_;
  mutable std::shared_ptr<const SceneBodies> bodies_;  ///< null until first used

  mutable std::mutex names_mutex_;
  mutable std::unordered_map<std::uint32_t, std::string> names_;  ///< given, or derived on request

  friend class SceneQuery;
  friend class SceneChange;
  std::atomic<bool> is_changing_ = false;
};

inline constinit HandlesForEver<HeldScene> scenes_for_ever(2);
inline Handles<HeldScene>& held_scenes() {
  return scenes_for_ever.handles;
}

/// Throws CallError if there is none of that number. The scene may be released at once: see
/// SceneUse.
HeldScene& scene_of(minkray_scene scene);

}  // namespace minkray
