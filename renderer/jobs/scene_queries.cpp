// SPDX-License-Identifier: MIT
#include "renderer/jobs/scene_queries.h"

#include "core/math/outward_sum.h"
#include "renderer/arguments/scene_file.h"
#include "renderer/film/render.h"
#include "renderer/import/import.h"
#include "renderer/json/number_json.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/parse.h"
#include "renderer/json/values.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {

bool SceneQueries::is_one(std::string_view line) {
  return line.find("\"scene\"") != line.npos && line.find("\"shape\"") == line.npos;
}

std::shared_ptr<const SceneQueries::Loaded> SceneQueries::load(const std::string& name) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const Loaded>& loaded = loaded_[name];
  if (!loaded) {
    auto made = std::make_shared<Loaded>();
    const std::filesystem::path beside = folder_ / name;
    std::error_code error;
    const bool is_file = beside.has_extension() || std::filesystem::exists(beside, error);
    made->scene = import_scene(is_file ? beside.string() : scene_file(name)).scene;
    made->world = make_world(made->scene);
    loaded = std::move(made);
  }
  return loaded;
}

std::optional<Json> SceneQueries::answer(std::string_view line, Mistakes& mistakes) {
  const auto json = parse_json(line, mistakes);
  if (!json) return std::nullopt;
  ObjectReader query(*json, JsonPath(), mistakes);
  std::string name, file;
  if (const Json* written = query.find("name"))
    name = read_string(*written, query.path("name"), mistakes).value_or("");
  if (const Json* written = query.find("query"))
    if (read_string(*written, query.path("query"), mistakes).value_or("ray") != "ray")
      mistakes.add(query.path("query"), "must be \"ray\" in a query with \"scene\"");
  if (const Json* written = query.require("scene", "a scene's file"))
    file = read_string(*written, query.path("scene"), mistakes).value_or("");
  Ray<double> ray;
  if (const Json* written = query.require("ray", "an object")) {
    ObjectReader object(*written, query.path("ray"), mistakes);
    const auto vector = [&](const char* key) {
      const Json* numbers = object.require(key, "3 numbers");
      const auto read = numbers ? read_vector(*numbers, object.path(key), mistakes) : std::nullopt;
      return read.value_or(Vec3<double>::Zero());
    };
    ray.origin = vector("origin");
    ray.direction = vector("direction");
    if (mistakes.none() && ray.direction.isZero(0))
      mistakes.add(object.path("direction"), "must not be zero (got [0, 0, 0])");
    if (const Json* limit = object.find("t_max"))
      ray.t_max = read_number(*limit, object.path("t_max"), mistakes, Range::not_negative)
                      .value_or(ray.t_max);
    object.finish();
  }
  query.finish();
  if (!mistakes.none()) return std::nullopt;

  const std::shared_ptr<const Loaded> loaded = load(file);
  QueryCounts counts;
  const WorldHit hit = loaded->world.closest_hit(ray, counts);
  Json result = Json::object();
  if (!name.empty()) result["name"] = name;
  // An exhausted cast may be in front of any other hit.
  const Status status = counts.exhausted > 0 ? Status::exhausted : hit.cast.status;
  result["status"] = std::string(name_of(status));
  if (hit.found()) {
    result["t"] = number_json(hit.cast.t());
    result["t_lo"] = number_json(sum_or_less(hit.cast.t_base, hit.cast.offset_lo));
    result["t_hi"] = number_json(sum_or_more(hit.cast.t_base, hit.cast.offset_hi));
    result["normal"] = point_json(hit.cast.normal);
    if (hit.part != no_part) result["triangle"] = hit.part;
    result["object"] = hit.instance;
    result["object_name"] = instance_object(loaded->scene, hit.instance).name;
  }
  return result;
}

}  // namespace minkray
