// SPDX-License-Identifier: MIT
// Registers running uses of a scene, so that no call changes or releases it meanwhile. Each thread
// lists the scenes that it uses (M. Michael, "Hazard Pointers: Safe Memory Reclamation for
// Lock-Free Objects", 2004). A use is listed before it checks for a change; a change is announced
// before it checks the lists. So at least one of the two sees the other.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>

#include "renderer/library/handles/c_header.h"

namespace minkray {

class HeldScene;

/// The scenes that one thread uses, the innermost last: callbacks may call again.
struct alignas(64) ThreadUses {
  static constexpr std::size_t most = 4;

  std::array<std::atomic<const HeldScene*>, most> scenes = {};
  std::size_t count = 0;  ///< read by its own thread alone
  std::atomic<bool> is_taken = true;
  ThreadUses* next = nullptr;
};

/// Keeps a scene from being released. Throws CallError if there is none of that number, or if calls
/// are nested too deep.
class SceneUse {
 public:
  SceneUse(const SceneUse&) = delete;
  SceneUse& operator=(const SceneUse&) = delete;

 protected:
  explicit SceneUse(minkray_scene scene);
  ~SceneUse() { end(); }
  void end() noexcept;

  HeldScene* scene_;
  ThreadUses& uses_;
};

/// A call that leaves the scene as it is. Throws CallError if the scene is being changed.
class SceneQuery : SceneUse {
 public:
  explicit SceneQuery(minkray_scene scene);
  const HeldScene& operator*() const { return *scene_; }
  const HeldScene* operator->() const { return scene_; }
};

/// A call that changes the scene. Throws CallError if any other call uses it.
class SceneChange : SceneUse {
 public:
  explicit SceneChange(minkray_scene scene);
  ~SceneChange();
  HeldScene& operator*() const { return *scene_; }
  HeldScene* operator->() const { return scene_; }

  /// Releases the scene, which must not be used afterwards.
  void release(minkray_scene scene);

 private:
  bool is_used_elsewhere() const;
};

}  // namespace minkray
