// SPDX-License-Identifier: MIT
// Calls that cast rays and prove what was answered.
#include <cmath>

#include "tests/fuzz/c_abi_program.h"

namespace minkray::fuzz {
namespace {

bool is_finite(const double (&v)[3]) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// Description of an error in one result.
std::string wrong_hit(const minkray_ray& ray, const minkray_hit& hit, std::uint32_t instances) {
  if (hit.status < MINKRAY_HIT || hit.status > MINKRAY_EXHAUSTED) return "no status";
  if (hit.status == MINKRAY_EXHAUSTED) return "";
  if (hit.status == MINKRAY_MISS) {
    const bool is_told = std::isinf(hit.t) && hit.t > 0 && std::isnan(hit.point[0]) &&
                         hit.object == MINKRAY_NO_OBJECT;
    return is_told ? "" : "a miss that has met something";
  }
  if (hit.object >= instances) return "a hit of no object";
  if (!std::isfinite(hit.t) || !is_finite(hit.point) || !is_finite(hit.normal))
    return "a hit that is not finite";
  if (!(hit.t >= 0 && hit.t <= ray.t_max)) return "a hit out of the ray";
  if (!(hit.t_lo <= hit.t && hit.t <= hit.t_hi)) return "a t that is not between its bounds";
  if (hit.status == MINKRAY_INSIDE && hit.t != 0) return "a ray that begins inside elsewhere";
  const double length = std::hypot(hit.normal[0], hit.normal[1], hit.normal[2]);
  constexpr double rounding = 1e-9;
  if (length != 0 && std::abs(length - 1) > rounding) return "a normal that is not of length 1";
  return "";
}

}  // namespace

void CallProgram::check_hits(const std::vector<minkray_ray>& rays, const Answers<minkray_hit>& hits,
                             std::uint32_t instances) {
  promises_.expect(hits.is_kept_behind(), "an answer too many");
  for (std::size_t i = 0; i < rays.size() && !wild_; ++i) {
    const std::string wrong = wrong_hit(rays[i], hits[i], instances);
    promises_.expect(wrong.empty(), wrong + ", of ray " + std::to_string(i) + ", t " +
                                        std::to_string(hits[i].t) + ", status " +
                                        std::to_string(hits[i].status));
  }
}

void CallProgram::cast() {
  const Given<minkray_scene> of = scene();
  const Given<std::vector<minkray_ray>> given = rays();
  const Given<const minkray_options*> how = options();
  const std::size_t count = given.value.size();
  HeldScene* held = model_of(of.value);
  const Sure sure =
      both(both(of.sure, held ? held->committed : Sure::wrong), both(given.sure, how.sure));
  Answers<minkray_hit> hits(count), again(count);
  int code = minkray_scene_cast(of.value, given.value.data(), count, hits.data(), how.value);
  if (!promises_.call("minkray_scene_cast", code, sure, hits.is_untouched())) return;
  check_hits(given.value, hits, held->objects + held->particles);
  // Cut into calls of one, and as arrays, the answers are the same.
  bool may_lie = false;
  for (std::size_t i = 0; i < count; ++i)
    may_lie |=
        minkray_scene_cast(of.value, &given.value[i], 1, again.data() + i, how.value) != MINKRAY_OK;
  if (may_lie) return;
  promises_.expect(hits == again, "other hits when the rays are asked one by one");

  minkray_ray_arrays arrays = {};
  arrays.size = sizeof arrays;
  arrays.origin_stride = arrays.direction_stride = arrays.t_max_stride = sizeof(minkray_ray);
  if (count > 0) {
    arrays.origins = given.value[0].origin;
    arrays.directions = given.value[0].direction;
    arrays.t_max = &given.value[0].t_max;
  }
  Answers<double> t(count), normals(3 * count);
  Answers<std::uint32_t> objects(count);
  Answers<std::uint8_t> status(count), blocked(count);
  minkray_hit_arrays places = {};
  places.size = sizeof places;
  places.t = t.data();
  places.normals = normals.data();
  places.objects = objects.data();
  places.status = status.data();
  Sure sizes = Sure::right;
  if (hostile()) arrays.size = 8, sizes = Sure::wrong;
  if (hostile()) places.size = 0, sizes = Sure::wrong;
  code = minkray_scene_cast_arrays(of.value, &arrays, count, &places, how.value);
  if (!promises_.call("minkray_scene_cast_arrays", code, sizes, t.is_untouched())) return;
  for (std::size_t i = 0; i < count; ++i)
    promises_.expect(std::memcmp(&t[i], &hits[i].t, sizeof t[i]) == 0 &&
                         objects[i] == hits[i].object && status[i] == hits[i].status &&
                         std::memcmp(&normals[3 * i], hits[i].normal, sizeof hits[i].normal) == 0,
                     "another hit in arrays than in structs");
  promises_.expect(t.is_kept_behind() && normals.is_kept_behind() && objects.is_kept_behind() &&
                       status.is_kept_behind(),
                   "an answer too many in arrays");
  code = minkray_scene_occluded(of.value, &arrays, count, blocked.data(), how.value);
  if (!promises_.call("minkray_scene_occluded", code, Sure::right, blocked.is_untouched())) return;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_met = status[i] == MINKRAY_HIT || status[i] == MINKRAY_INSIDE;
    promises_.expect(blocked[i] == (is_met ? MINKRAY_HIT : MINKRAY_MISS) ||
                         blocked[i] == MINKRAY_EXHAUSTED || status[i] == MINKRAY_EXHAUSTED,
                     "a ray that is blocked and meets nothing, or the other way round: ray " +
                         std::to_string(i));
  }
  // All hits: sorted, and one where the first is, unless it begins inside.
  struct Taken {
    const Answers<std::uint8_t>* status;
    std::size_t calls = 0, wrong = 0;
  } taken{&status};
  const auto take = [](void* user, const minkray_all_hits* found) {
    auto& to = *static_cast<Taken*>(user);
    ++to.calls;
    for (std::size_t i = 0; i < found->rays; ++i) {
      const std::size_t begin = found->offsets[i], end = found->offsets[i + 1];
      to.wrong += (*to.status)[i] == MINKRAY_HIT && begin == end ? 1 : 0;
      for (std::size_t k = begin + 1; k < end; ++k)
        to.wrong += found->hits[k].t < found->hits[k - 1].t ? 1 : 0;
    }
    return 0;
  };
  code = minkray_scene_all_hits(of.value, &arrays, count, take, &taken, how.value);
  if (!promises_.call("minkray_scene_all_hits", code, Sure::right, taken.calls == 0)) return;
  promises_.expect(taken.calls == 1 && taken.wrong == 0, "other hits among all than first ones");
}

void CallProgram::cast_at_one() {
  const Given<std::vector<minkray_ray>> given = rays();
  const Given<const minkray_options*> how = options();
  const std::size_t count = given.value.size();
  const Sure asked = both(given.sure, how.sure);
  Answers<minkray_hit> hits(count), again(count);
  if (bytes_.below(2) == 0) {
    const Given<minkray_shape> what = shape();
    const Given<const minkray_pose*> where = pose();
    const auto cast = [&](Answers<minkray_hit>& to) {
      return minkray_shape_cast(what.value, where.value, given.value.data(), count, to.data(),
                                how.value);
    };
    if (!promises_.call("minkray_shape_cast", cast(hits), both(asked, both(what.sure, where.sure)),
                        hits.is_untouched()))
      return;
    check_hits(given.value, hits, 1);
    if (cast(again) == MINKRAY_OK)
      promises_.expect(hits == again, "other hits of a shape when it is asked again");
    return;
  }
  const Given<minkray_scene> of = scene();
  const std::uint32_t object = bytes_.byte() % 8;
  HeldScene* held = model_of(of.value);
  Sure sure = both(both(asked, of.sure), held ? held->committed : Sure::wrong);
  if (!held || object >= held->objects + held->particles) sure = both(sure, Sure::wrong);
  const int code =
      minkray_scene_exit(of.value, object, given.value.data(), count, hits.data(), how.value);
  // The object may be a half-space.
  promises_.call("minkray_scene_exit", code, both(sure, Sure::either), hits.is_untouched());
  promises_.expect(hits.is_kept_behind(), "an answer too many");
}

void CallProgram::prove() {
  const Given<minkray_scene> of = scene();
  const Given<std::vector<minkray_ray>> given = rays();
  const std::size_t count = given.value.size();
  HeldScene* held = model_of(of.value);
  const Sure sure = both(both(of.sure, held ? held->committed : Sure::wrong), given.sure);
  Answers<minkray_hit> hits(count);
  if (!promises_.call("minkray_scene_cast",
                      minkray_scene_cast(of.value, given.value.data(), count, hits.data(), nullptr),
                      sure, hits.is_untouched()))
    return;
  if (count > 0 && bytes_.below(3) == 0) {  // corrupts the result
    minkray_hit& changed = hits.data()[bytes_.byte() % count];
    changed.t_base = number();
    changed.status = bytes_.below(6) - 1;
    changed.object = bytes_.below(4) == 0 ? MINKRAY_NO_OBJECT : bytes_.byte() % 4;
    if (bytes_.below(3) == 0)
      for (double& x : changed.normal) x = number();
  }
  Answers<minkray_proof> proofs(count), again(count);
  const auto prove_to = [&](Answers<minkray_proof>& to) {
    return minkray_scene_prove(of.value, given.value.data(), hits.data(), count, to.data(),
                               nullptr);
  };
  if (!promises_.call("minkray_scene_prove", prove_to(proofs), Sure::right, proofs.is_untouched()))
    return;
  promises_.expect(proofs.is_kept_behind(), "a proof too many");
  for (std::size_t i = 0; i < count; ++i) {
    const minkray_proof& proof = proofs[i];
    const bool ends = std::memchr(proof.complaint, 0, sizeof proof.complaint) != nullptr;
    promises_.expect(ends && (proof.holds == 0 || proof.holds == 1), "a proof that says nothing");
    promises_.expect((proof.holds == 0) == (proof.complaint[0] != '\0'),
                     "a complaint of a proof that holds, or none of one that does not");
  }
  if (prove_to(again) == MINKRAY_OK)
    promises_.expect(proofs == again, "another proof when it is asked again");
}

}  // namespace minkray::fuzz
