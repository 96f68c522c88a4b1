// SPDX-License-Identifier: MIT
// C interface: proofs of results.
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/prover.h"
#include "renderer/library/handles/ray_source.h"
#include "renderer/library/handles/work_on_rays.h"

using namespace minkray;

extern "C" int minkray_scene_prove(minkray_scene scene, const minkray_ray* rays,
                                   const minkray_hit* hits, size_t count, minkray_proof* proofs,
                                   const minkray_options* options) {
  return call("minkray_scene_prove", [&] {
    const SceneQuery held(scene);
    if (count > 0) {
      require(hits, "hits");
      require(proofs, "proofs");
    }
    const RaySource source(rays, count);
    const Prover prover(*held);
    work_on_groups(count, 1, are_gathered(held->customs()), options,
                   [&](size_t i, size_t) { proofs[i] = prover.prove(source[i], hits[i]); });
    throw_if_lied(held->customs());
  });
}
