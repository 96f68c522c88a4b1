// SPDX-License-Identifier: MIT
#include "renderer/library/handles/scene_use.h"

#include <memory>
#include <thread>

#if defined(__linux__)
#include <linux/membarrier.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_scene.h"

namespace minkray {
namespace {

/// The lists of all threads that ever used a scene; those of threads that ended are taken again.
constinit std::atomic<ThreadUses*> all_uses = nullptr;

/// This thread's list. In the initial TLS block, so that it is read without a call.
[[gnu::tls_model("initial-exec")]] constinit thread_local ThreadUses* own_uses = nullptr;

/// Gives the list back when its thread ends.
struct EndOfThread {
  ~EndOfThread() {
    if (own_uses) own_uses->is_taken.store(false, std::memory_order_release);
    own_uses = nullptr;
  }
};

[[gnu::noinline, gnu::cold]] ThreadUses& new_uses() {
  thread_local EndOfThread end;
  (void)end;
  for (ThreadUses* uses = all_uses.load(); uses; uses = uses->next)
    if (!uses->is_taken.exchange(true)) return *(own_uses = uses);
  own_uses = new ThreadUses;
  own_uses->next = all_uses.load();
  while (!all_uses.compare_exchange_weak(own_uses->next, own_uses)) {
  }
  return *own_uses;
}

#if defined(__linux__)
bool membarrier(int command) {
  return syscall(SYS_membarrier, command, 0, 0) == 0;
}
/// True if a thread can make all threads of this process execute a barrier. Uses then need none of
/// their own, which would take most of the time of a use.
const bool has_barrier_for_all = membarrier(MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED);
#else
constexpr bool has_barrier_for_all = false;
#endif

/// Orders this thread's stores before its loads, and the same for every thread that lists a use.
void barrier_for_all() {
#if defined(__linux__)
  // A forked process may have to register again.
  if (has_barrier_for_all && (membarrier(MEMBARRIER_CMD_PRIVATE_EXPEDITED) ||
                              (membarrier(MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED) &&
                               membarrier(MEMBARRIER_CMD_PRIVATE_EXPEDITED))))
    return;
#endif
  std::atomic_thread_fence(std::memory_order_seq_cst);
}

ThreadUses& uses_of_this_thread() {
  return own_uses ? *own_uses : new_uses();
}

}  // namespace

SceneUse::SceneUse(minkray_scene scene) : scene_(&scene_of(scene)), uses_(uses_of_this_thread()) {
  if (uses_.count == ThreadUses::most)
    wrong_use("scene: must not be used in calls within calls more than " +
              std::to_string(ThreadUses::most) + " deep");
  uses_.scenes[uses_.count++].store(scene_, std::memory_order_relaxed);
  if (has_barrier_for_all)
    std::atomic_signal_fence(std::memory_order_seq_cst);
  else
    std::atomic_thread_fence(std::memory_order_seq_cst);
  // Released, and perhaps gone, since it was found.
  if (held_scenes().find(scene.id) == scene_) return;
  end();
  scene_of(scene);
}

void SceneUse::end() noexcept {
  uses_.scenes[--uses_.count].store(nullptr, std::memory_order_release);
}

SceneQuery::SceneQuery(minkray_scene scene) : SceneUse(scene) {
  if (scene_->is_changing_.load(std::memory_order_seq_cst))
    wrong_use("scene: must not be used while another call is changing it");
}

SceneChange::SceneChange(minkray_scene scene) : SceneUse(scene) {
  if (scene_->is_changing_.exchange(true, std::memory_order_seq_cst))
    wrong_use("scene: must not be changed while another call is changing it");
  if (!is_used_elsewhere()) return;
  scene_->is_changing_.store(false, std::memory_order_release);
  wrong_use("scene: must not be changed or released while another call uses it");
}

SceneChange::~SceneChange() {
  if (scene_) scene_->is_changing_.store(false, std::memory_order_release);
}

bool SceneChange::is_used_elsewhere() const {
  const ThreadUses* const first = all_uses.load(std::memory_order_seq_cst);
  const bool is_first_alone = first == &uses_ && !first->next;
  // A thread that is listed from now on sees that the scene is being changed.
  if (is_first_alone && uses_.count == 1) return false;
  barrier_for_all();
  for (const ThreadUses* uses = first; uses; uses = uses->next)
    for (std::size_t i = 0; i < ThreadUses::most; ++i) {
      const bool is_this = uses == &uses_ && i + 1 == uses_.count;
      if (!is_this && uses->scenes[i].load(std::memory_order_seq_cst) == scene_) return true;
    }
  return false;
}

void SceneChange::release(minkray_scene scene) {
  const std::unique_ptr<HeldScene> last = held_scenes().take(scene.id);
  // Calls that found it by its number before are about to find that it is being changed.
  while (is_used_elsewhere()) std::this_thread::yield();
  scene_ = nullptr;
}

}  // namespace minkray
