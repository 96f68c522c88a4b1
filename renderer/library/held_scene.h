// SPDX-License-Identifier: MIT
// A scene as programs in other languages hold it: objects are added and moved, and then committed,
// by which rays meet them.
#pragma once

#include <atomic>
#include <optional>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/world/world.h"
#include "renderer/import/import.h"
#include "renderer/library/call.h"
#include "renderer/library/custom_support.h"
#include "renderer/library/handles.h"
#include "renderer/library/held_shape.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// One thread changes it, or any number ask.
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

  /// While one exists, no other thread can change the scene. Throws CallError if one does.
  class Change {
   public:
    explicit Change(HeldScene& scene);
    ~Change() { scene_.is_changing_.store(false, std::memory_order_release); }
    Change(const Change&) = delete;
    Change& operator=(const Change&) = delete;

   private:
    HeldScene& scene_;
  };

  std::uint32_t add(const HeldShape& shape, const Affine<double>& pose, const char* name);
  std::uint32_t add(const HalfSpaceBody<double>& half_space, const char* name);
  std::uint32_t add_file(const std::string& file, const ImportOptions& options,
                         const std::optional<Affine<double>>& pose);
  void set_pose(std::uint32_t object, const Affine<double>& pose);
  void set_group_pose(std::uint32_t group, const Affine<double>& pose);
  void set_joint(std::uint32_t group, const std::string& name, std::span<const double> values);
  void commit();

  /// Throws CallError if the number is that of no object; of no group.
  const Object& object(std::uint32_t object) const;
  const Group& group(std::uint32_t group) const;

  const Scene& plain() const { return scene_; }
  /// Whether a file had one.
  bool has_camera() const { return has_camera_; }
  const std::vector<std::shared_ptr<const CustomSupport>>& customs() const { return customs_; }

  /// What rays are cast at. Throws CallError if the scene was not committed since it was changed,
  /// or is being changed.
  const World& world() const;

 private:
  /// What the next commit has to do.
  enum class Due { nothing, refit, build };

  void check_room(std::size_t more) const;
  std::uint32_t append(Object object, const char* name);
  void append(Scene&& from);
  void place(Group& group);

  Scene scene_;
  std::optional<std::uint32_t> grey_;  ///< the material of what is added without one
  bool has_camera_ = false;            ///< and lights, of the first file that has them
  std::vector<Group> groups_;
  std::vector<std::shared_ptr<const CustomSupport>> customs_;  ///< each once
  std::unordered_set<const CustomSupport*> known_customs_;
  World world_;
  Due due_ = Due::build;
  std::atomic<bool> is_changing_ = false;
};

Handles<HeldScene>& held_scenes();

/// Throws CallError if there is none of that number.
HeldScene& scene_of(minkray_scene scene);

}  // namespace minkray
