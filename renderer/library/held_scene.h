// SPDX-License-Identifier: MIT
// A scene as programs in other languages hold it: objects are added and moved, and then committed,
// by which rays meet them.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "renderer/base/real.h"
#include "renderer/import/import.h"
#include "renderer/library/call.h"
#include "renderer/library/custom_support.h"
#include "renderer/library/handles.h"
#include "renderer/library/held_shape.h"
#include "renderer/library/scene_use.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// One call changes it, or any number ask: see scene_use.h.
class HeldScene {
 public:
  /// Objects that came from one file.
  struct Group {
    std::uint32_t first = 0, count = 0;
    Affine<double> pose;                  ///< of all of them
    std::vector<Affine<double>> in_file;  ///< where they stand in the file's frame
    bool has_particles = false;           ///< which have no poses of their own
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

  /// Throws CallError if the number is that of no object, or of a removed one; of no group.
  const Object& object(std::uint32_t object) const;
  const Group& group(std::uint32_t group) const;
  bool is_removed(std::uint32_t object) const {
    return !removed_.empty() && removed_.contains(object);
  }
  /// What a joint of the group is set to.
  std::vector<double> joint_value(const Group& group, const std::string& name) const;
  /// The object's name, at a place where it stays as long as the scene.
  const char* name(std::uint32_t object) const;

  const Scene& plain() const { return scene_; }
  /// Whether a file had one.
  bool has_camera() const { return has_camera_; }
  const std::vector<std::shared_ptr<const CustomSupport>>& customs() const { return customs_; }

  /// What rays are cast at. Throws CallError if the scene was not committed since it was changed,
  /// or if this is called from within the support function of a shape in it.
  const RenderWorld& world() const;

 private:
  /// What the next commit has to do.
  enum class Due { nothing, refit, build };

  void check_room(std::size_t more) const;
  std::uint32_t grey();
  void keep_customs(const std::vector<std::shared_ptr<const CustomSupport>>& customs);
  std::uint32_t append(Object object, const char* name);
  void append(Scene&& from);
  void place(Group& group);

  Scene scene_;
  std::optional<std::uint32_t> grey_;  ///< the material of what is added without one
  bool has_camera_ = false;            ///< and lights, of the first file that has them
  std::vector<Group> groups_;
  std::vector<std::shared_ptr<const CustomSupport>> customs_;  ///< each once
  std::unordered_set<const CustomSupport*> known_customs_;
  std::unordered_set<std::uint32_t> removed_;
  RenderWorld world_;
  Due due_ = Due::build;

  mutable std::mutex names_mutex_;
  mutable std::unordered_map<std::uint32_t, std::string> names_;  ///< that were asked for

  friend class SceneQuery;
  friend class SceneChange;
  std::atomic<bool> is_changing_ = false;
};

inline constinit HandlesForEver<HeldScene> scenes_for_ever(2);
inline Handles<HeldScene>& held_scenes() {
  return scenes_for_ever.handles;
}

/// Throws CallError if there is none of that number. It may be released at once: see SceneUse.
HeldScene& scene_of(minkray_scene scene);

}  // namespace minkray
