// SPDX-License-Identifier: MIT
// C interface: queries on the pairs of a scene.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "core/parallel/parallel.h"
#include "renderer/base/errors.h"
#include "renderer/clearance/allowed_pairs.h"
#include "renderer/import/scene_of_model.h"
#include "renderer/library/handles/bodies_of_pairs.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_scene.h"
#include "renderer/library/handles/pair_answers.h"
#include "renderer/library/handles/poses.h"
#include "renderer/library/handles/scene_bodies.h"
#include "renderer/library/handles/share_of_call.h"
#include "renderer/library/handles/work_on_rays.h"

namespace minkray {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t all_categories = ~std::uint32_t{0};

struct NearQuery {
  double within = 0;
  SignedDistanceOptions distances;
  bool derive = false;
  std::uint32_t mask = all_categories;
  double* jac_error = nullptr;
  const double** jac_errors = nullptr;
};

/// `within`: the default.
NearQuery query_of(const minkray_near_options* options, double within) {
  NearQuery query;
  query.within = within;
  if (!options) return query;
  if (options->size < offsetof(minkray_near_options, jac_error))
    wrong_use("options.size: must be sizeof(minkray_near_options)");
  if (!(options->within >= 0))
    wrong_use("options.within: must be >= 0 (got " + std::to_string(options->within) + ")");
  const minkray_distance_options plain = {sizeof plain, options->tolerance, 0, 0, 0};
  if (options->within != 0) query.within = options->within;
  query.distances = distance_options(&plain);
  query.derive = options->derivatives != 0;
  if (options->mask != 0) query.mask = options->mask;
  if (options->size >= offsetof(minkray_near_options, jac_errors))
    query.jac_error = options->jac_error;
  if (options->size >= sizeof(minkray_near_options)) query.jac_errors = options->jac_errors;
  return query;
}

std::uint32_t checked_object(const HeldScene& scene, std::uint32_t number,
                             const std::string& argument) {
  const std::size_t count = scene.world().instances().size();
  if (number >= count)
    wrong_use(argument + ": must be less than " + std::to_string(count) + " (got " +
              std::to_string(number) + ")");
  if (scene.is_removed(number))
    wrong_use(argument + ": must not be removed (got " + std::to_string(number) + ")");
  return number;
}

/// Two objects that can be a pair, whose numbers are not the same.
void check_two(std::uint32_t a, std::uint32_t b, const std::string& argument) {
  if (a == b) wrong_use(argument + ": must be two objects (got " + std::to_string(a) + " twice)");
}

void put_twist(const TwistDerivative& derivative, double (&to)[6]) {
  put(derivative.by_velocity, to, 0);
  put(derivative.by_turn, to, 1);
}

minkray_scene_pair plain_pair(const ScenePair& pair) {
  minkray_scene_pair plain = {};
  plain.distance = plain_distance(pair.distance);
  plain.object_a = pair.a;
  plain.object_b = pair.b;
  return plain;
}

void put_error(const TwistError& error, double* to) {
  to[0] = error.by_velocity;
  to[1] = error.by_turn;
}

/// The pair, and its derivative if that is requested. `errors`: four numbers, or null.
/// derive(error) computes it.
template <class Derive>
minkray_scene_pair plain_pair(const ScenePair& pair, const NearQuery& query, double* errors,
                              const Derive& derive) {
  minkray_scene_pair plain = plain_pair(pair);
  if (!query.derive && !errors) return plain;
  PairDerivativeError error;
  const PairDerivative derivative = derive(errors ? &error : nullptr);
  if (errors) {
    put_error(error.a, errors);
    put_error(error.b, errors + 2);
  }
  if (!query.derive) return plain;
  put_twist(derivative.a, plain.jac_a);
  put_twist(derivative.b, plain.jac_b);
  plain.is_ridge = derivative.is_ridge ? 1 : 0;
  return plain;
}

/// Result if there is no object.
minkray_scene_pair no_pair(double within, bool derive) {
  minkray_scene_pair none = {};
  if (derive) {
    std::ranges::fill(none.jac_a, not_a_number);
    std::ranges::fill(none.jac_b, not_a_number);
  }
  none.distance.value = none.distance.upper = infinite;
  none.distance.lower = within;
  none.distance.status = MINKRAY_SEPARATED;
  none.object_a = none.object_b = MINKRAY_NO_OBJECT;
  return none;
}

/// Writes the i-th result, a pair of the body `to` or null.
void put_result(std::size_t i, const ScenePair* found, const ContactBody& to,
                const NearQuery& query, const SceneBodies& bodies, minkray_scene_pair* results) {
  double* const errors = query.jac_error ? query.jac_error + 4 * i : nullptr;
  if (found) {
    results[i] = plain_pair(*found, query, errors, [&](PairDerivativeError* error) {
      return bodies.derivative(to, *found, error);
    });
    return;
  }
  results[i] = no_pair(query.within, query.derive);
  if (errors) std::fill_n(errors, 4, not_a_number);
}

std::vector<ScenePair> given_pairs(const HeldScene& held, const std::uint32_t* pairs,
                                   std::size_t count, const NearQuery& query, const RunParts& run) {
  const SceneBodies& bodies = held.bodies();
  std::vector<ScenePair> found(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string argument = "pairs[" + std::to_string(i) + "]";
    found[i].a = checked_object(held, pairs[2 * i], argument + "[0]");
    found[i].b = checked_object(held, pairs[2 * i + 1], argument + "[1]");
    check_two(found[i].a, found[i].b, argument);
    if (bodies.is_half_space(found[i].a) && bodies.is_half_space(found[i].b))
      wrong_use(argument + ": must not be two half-spaces");
  }
  SignedDistanceOptions how = query.distances;
  how.at_most = query.within;
  constexpr std::size_t part_size = 64;
  run(count, part_size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      found[i].distance = bodies.distance(found[i].a, found[i].b, how);
  });
  std::erase_if(found, [&](const ScenePair& pair) { return pair.distance.lower > query.within; });
  return found;
}

/// A robot's objects by the names of their links.
std::map<std::string, std::vector<std::uint32_t>> objects_of_links(const HeldScene::Group& robot) {
  std::map<std::string, std::vector<std::uint32_t>> objects;
  const Model& model = *robot.model;
  const std::vector<bool> chosen = chosen_geoms(model, robot.options.geometry);
  std::uint32_t object = robot.first;
  for (std::size_t i = 0; i < model.geoms.size(); ++i) {
    if (!chosen[i]) continue;
    if (const int link = model.geoms[i].link; link >= 0)
      objects[model.links[static_cast<std::size_t>(link)].name].push_back(object);
    ++object;
  }
  return objects;
}

/// Calls body(i) for all, few at a time.
void for_all(const HeldScene& held, std::size_t count, const minkray_options* how,
             const std::function<void(std::size_t)>& body) {
  constexpr std::size_t grain = 16;
  work_on_parts(count, grain, how, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
  throw_if_lied(held.customs());
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

int minkray_scene_set_masks(minkray_scene scene, uint32_t object, uint32_t category,
                            uint32_t mask) {
  return call("minkray_scene_set_masks", [&] {
    const SceneChange held(scene);
    held->check_object(object);
    held->changed_pair_rules().set_masks(object, {category, mask});
  });
}

int minkray_scene_allow(minkray_scene scene, uint32_t object_a, uint32_t object_b, int is_allowed) {
  return call("minkray_scene_allow", [&] {
    const SceneChange held(scene);
    held->check_object(object_a, "object_a");
    held->check_object(object_b, "object_b");
    check_two(object_a, object_b, "object_b");
    held->changed_pair_rules().allow(object_a, object_b, is_allowed != 0);
  });
}

int minkray_scene_allow_from_srdf(minkray_scene scene, uint32_t group, const char* file) {
  return call("minkray_scene_allow_from_srdf", [&] {
    const SceneChange held(scene);
    require(file, "file");
    const HeldScene::Group& robot = held->group(group);
    if (!robot.model) wrong_use("group: must be a robot's, from URDF, MJCF, SDF or glTF");
    AllowedPairs allowed;
    Mistakes mistakes(file);
    read_srdf(file, *robot.model, allowed, mistakes);
    throw_if_any(mistakes);
    const auto objects = objects_of_links(robot);
    PairRules& rules = held->changed_pair_rules();
    for (const auto& [link_a, link_b] : allowed.pairs()) {
      const auto of_a = objects.find(link_a), of_b = objects.find(link_b);
      if (link_a == link_b || of_a == objects.end() || of_b == objects.end()) continue;
      for (const std::uint32_t a : of_a->second)
        for (const std::uint32_t b : of_b->second) rules.allow(a, b, true);
    }
  });
}

int minkray_scene_distances(minkray_scene scene, const uint32_t* pairs, size_t count,
                            const minkray_near_options* options, minkray_take_pairs take,
                            void* user, const minkray_options* how) {
  return call("minkray_scene_distances", [&] {
    const SceneQuery held(scene);
    if (!take) wrong_null("take");
    const NearQuery query = query_of(options, pairs ? infinite : 0);
    std::vector<minkray_scene_pair> plain;
    std::vector<double> errors;
    const int threads = threads_of(how);
    const bool derive = query.derive || query.jac_errors;
    const ShareOfCall first(how, 0, derive ? 0.5 : 1), rest(how, 0.5, 1);
    with_threads(threads, [&] {
      const SceneBodies& bodies = held->bodies();
      const RunParts run = [&](const auto&... of_parts) { first.run(of_parts...); };
      const std::vector<ScenePair> found =
          pairs ? given_pairs(*held, pairs, count, query, run)
                : bodies.near(query.within, query.distances.tolerance, run);
      plain.resize(found.size());
      if (query.jac_errors) errors.resize(4 * found.size());
      constexpr std::size_t part_size = 256;
      const auto part = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          plain[i] = plain_pair(found[i], query, query.jac_errors ? &errors[4 * i] : nullptr,
                                [&](auto* error) { return bodies.derivative(found[i], error); });
      };
      if (derive)
        rest.run(found.size(), part_size, part);
      else
        parallel_for(found.size(), part_size, part);
    });
    throw_if_lied(held->customs());
    if (query.jac_errors) *query.jac_errors = errors.data();
    const int stop = take(user, plain.data(), plain.size());
    if (query.jac_errors) *query.jac_errors = nullptr;
    if (stop != 0) throw CallError(MINKRAY_STOPPED, "stopped by the caller");
  });
}

int minkray_scene_nearest(minkray_scene scene, const double (*points)[3], size_t count, size_t k,
                          const minkray_near_options* options, minkray_scene_pair* nearest,
                          const minkray_options* how) {
  return call("minkray_scene_nearest", [&] {
    const SceneQuery held(scene);
    if (k == 0) wrong_use("k: must be at least 1 (got 0)");
    if (count > 0) {
      require(points, "points");
      require(nearest, "nearest");
    }
    require_room(count, k * sizeof(minkray_scene_pair), "count");
    for (size_t i = 0; i < count; ++i)
      vector_of(points[i], "points", ("[" + std::to_string(i) + "]").c_str());
    const NearQuery query = query_of(options, infinite);
    const SceneBodies& bodies = held->bodies();
    const ContactShape point{Shape(Point())};
    for_all(*held, count, how, [&](size_t i) {
      ContactBody to{point, {}, all_categories, query.mask};
      to.pose.translation = {points[i][0], points[i][1], points[i][2]};
      const std::vector<ScenePair> found = bodies.nearest(to, k, query.within);
      for (size_t j = 0; j < k; ++j)
        put_result(i * k + j, j < found.size() ? &found[j] : nullptr, to, query, bodies, nearest);
    });
  });
}

int minkray_scene_distance_to(minkray_scene scene, const minkray_bodies* shapes, size_t count,
                              const minkray_near_options* options, minkray_scene_pair* nearest,
                              const minkray_options* how) {
  return call("minkray_scene_distance_to", [&] {
    const SceneQuery held(scene);
    const BodiesOfPairs all(shapes, count, "shapes");
    if (count > 0) require(nearest, "nearest");
    const NearQuery query = query_of(options, infinite);
    const SceneBodies& bodies = held->bodies();
    for_all(*held, count, how, [&](size_t i) {
      PosedBody body;
      all.read(i, body);
      const ContactBody to{body.shape_or_point(), body.pose(),    all_categories, query.mask,
                           body.mesh(),           body.compound()};
      const std::vector<ScenePair> found = bodies.nearest(to, 1, query.within);
      put_result(i, found.empty() ? nullptr : &found[0], to, query, bodies, nearest);
    });
    throw_if_lied(all.customs());
  });
}

int minkray_scene_time_of_impact(minkray_scene scene, const minkray_bodies* shapes, size_t count,
                                 const double* t_max, size_t t_max_count,
                                 const minkray_near_options* options, minkray_scene_impact* impacts,
                                 const minkray_options* how) {
  return call("minkray_scene_time_of_impact", [&] {
    const SceneQuery held(scene);
    const BodiesOfPairs all(shapes, count, "shapes");
    if (count > 0) require(impacts, "impacts");
    check_ends(t_max, t_max_count, count);
    const NearQuery query = query_of(options, infinite);
    const SceneBodies& bodies = held->bodies();
    for_all(*held, count, how, [&](size_t i) {
      PosedBody body;
      all.read(i, body);
      const RigidMotion motion = all.motion(i, body);
      const double end = t_max[t_max_count == 1 ? 0 : i];
      const EarliestImpact found = bodies.first_impact(body.parts(), motion, end, query.mask);
      minkray_scene_impact& told = impacts[i];
      told = {};
      told.impact = plain_impact(found.impact);
      told.object = found.body == EarliestImpact::none ? MINKRAY_NO_OBJECT
                                                       : static_cast<uint32_t>(found.body);
      if (!query.derive && !query.jac_error) return;
      PairDerivativeError error;
      const PairDerivative derivative = bodies.derivative(body.parts(), motion, found, query.mask,
                                                          query.jac_error ? &error : nullptr);
      if (query.jac_error) put_error(error.a, query.jac_error + 2 * i);
      if (!query.derive) return;
      put_twist(derivative.a, told.jac);
      told.is_ridge = derivative.is_ridge ? 1 : 0;
    });
    throw_if_lied(all.customs());
  });
}

int minkray_scene_manifold(minkray_scene scene, uint32_t object_a, uint32_t object_b,
                           minkray_manifold* manifold) {
  return call("minkray_scene_manifold", [&] {
    const SceneQuery held(scene);
    require(manifold, "manifold");
    checked_object(*held, object_a, "object_a");
    checked_object(*held, object_b, "object_b");
    check_two(object_a, object_b, "object_b");
    const SceneBodies& bodies = held->bodies();
    if (bodies.is_half_space(object_a) && bodies.is_half_space(object_b))
      wrong_use("object_b: must not be a half-space, as object_a is");
    const SignedDistance nearest = bodies.distance(object_a, object_b, {});
    const ContactManifold found = bodies.manifold(object_a, object_b, nearest);
    throw_if_lied(held->customs());
    *manifold = plain_manifold(nearest, found);
  });
}

}  // extern "C"
