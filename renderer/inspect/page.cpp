// SPDX-License-Identifier: MIT
#include "renderer/inspect/page.h"

#include <set>

#include "core/support/named_kind.h"
#include "renderer/film/heatmap.h"
#include "renderer/inspect/base64.h"
#include "renderer/inspect/page_files.h"
#include "renderer/inspect/pair_replay.h"
#include "renderer/inspect/pixel_answers.h"
#include "renderer/inspect/replay_choice.h"
#include "renderer/inspect/replay_lines.h"
#include "renderer/inspect/shape_mesh.h"
#include "renderer/io/deflate.h"
#include "renderer/io/image_file.h"
#include "renderer/json/number_json.h"
#include "renderer/paper/solvers.h"
#include "renderer/rays/camera.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

/// Number of pixels added between two checks that the page is not full.
constexpr std::size_t pixels_between_looks = 4;

/// Pages that show more objects have coarser meshes of them.
constexpr std::size_t most_fine_meshes = 40;

/// Space reserved for those and their shapes, packed.
constexpr std::size_t reserve_bytes = 60'000;

std::string packed_text(std::span<const unsigned char> bytes) {
  Deflater deflater;
  deflater.add(bytes);
  return base64(deflater.finish());
}

/// Escapes text so that it cannot end the enclosing script.
std::string for_script(std::string text) {
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;)
    text.replace(at, 1, "\\u003c");
  return text;
}

void put(std::string& page, std::string_view mark, std::string_view text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw std::logic_error("the page has no " + std::string(mark));
  page.replace(at, mark.size(), text);
}

Json solvers_json(const std::vector<InspectedSolver>& solvers) {
  Json list = Json::array();
  for (const InspectedSolver& solver : solvers)
    if (const NamedSolver* known = row_named(named_solvers, solver.name))
      list.push_back({{"name", solver.name}, {"doc", std::string(known->doc)}});
  return list;
}

Json all_solvers_json() {
  Json list = Json::array();
  for (const auto& description : named_solvers)
    list.push_back(
        {{"name", std::string(description.name)}, {"doc", std::string(description.doc)}});
  return list;
}

Json camera_json(const CameraDescription& camera) {
  return {{"position", point_json(camera.position)},
          {"look_at", point_json(camera.look_at)},
          {"up", point_json(camera.up)}};
}

struct Replays {
  std::vector<unsigned char> packed;
  std::size_t pixels = 0;
};

/// Pairs first, then as many pixels as fit.
Replays replays_within(std::size_t most_bytes, const Scene& scene,
                       const std::vector<InspectedSolver>& solvers, const PixelAnswers& answers,
                       std::size_t pairs, const RenderWatch& watch) {
  Deflater deflater;
  for (const ObjectPair& pair : nearest_pairs(scene, pairs)) {
    auto replay = pair_json(scene, pair);
    if (!replay) continue;
    const Json line{{"kind", "pair"}, {"pair", *std::move(replay)}};
    deflater.add(line.dump() + "\n");
  }
  Replays replays;
  std::set<std::uint32_t> objects;
  for (const ShownCast& cast : answers.shown) objects.insert(cast.object);
  ReplayLines lines(objects.size() > most_fine_meshes ? coarse_mesh : fine_mesh);
  const Camera camera(scene.camera, answers.resolution);
  const auto width = static_cast<std::size_t>(answers.resolution.width);
  for (const std::size_t pixel : replay_order(answers)) {
    if (watch.stopped()) break;
    if (replays.pixels % pixels_between_looks == 0 && deflater.size() + reserve_bytes > most_bytes)
      break;
    const ShownCast& shown = answers.shown[pixel];
    if (!shown.has_steps) continue;
    const double x = static_cast<double>(pixel % width) + 0.5,
                 y = static_cast<double>(pixel / width) + 0.5;
    for (std::size_t k = 0; k < solvers.size(); ++k)
      deflater.add(lines.ray(solvers[k].casts, k, shown.shown(), {x, y, camera.ray(x, y)}));
    ++replays.pixels;
  }
  replays.packed = deflater.finish();
  return replays;
}

}  // namespace

Json view_json(const Scene& scene, const std::vector<InspectedSolver>& solvers,
               const PixelAnswers& answers) {
  const PackedPlanes planes = packed(answers);
  std::set<std::uint32_t> objects;
  for (const ShownCast& cast : answers.shown) objects.insert(cast.object);
  Json names = Json::object();
  for (const std::uint32_t object : objects)
    if (object > 0) names[std::to_string(object)] = instance_object(scene, object - 1).name;
  return {{"resolution", Json::array({answers.resolution.width, answers.resolution.height})},
          {"solvers", solvers_json(solvers)},
          {"names", std::move(names)},
          {"planes", planes.list},
          {"bytes", packed_text(planes.bytes)}};
}

InspectPage inspect_page(const Scene& scene, const std::vector<InspectedSolver>& solvers,
                         const InspectOptions& options, const RenderWatch& watch) {
  InspectPage result;
  const Rendering rendering = render(scene, solvers.front().casts.world(), options.picture, watch);
  std::vector<const SceneCasts*> casts;
  for (const InspectedSolver& solver : solvers) casts.push_back(&solver.casts);
  const PixelAnswers answers = measure_pixels(scene, casts, options.picture.resolution, watch);
  if (!rendering.complete || !answers.complete) return result;

  Json statuses = Json::array(), paths = Json::array();
  for (const Status status : heat_statuses) statuses.push_back(std::string(name_of(status)));
  for (std::size_t i = 0; i < path_count; ++i)
    paths.push_back(std::string(name_of(static_cast<Path>(i))));
  Json object_names = Json::array();
  for (const Object& object : scene.objects) object_names.push_back(object.name);
  const Json about{{"name", options.name},
                   {"description", scene.description},
                   {"served", options.is_served},
                   {"statuses", std::move(statuses)},
                   {"paths", std::move(paths)},
                   {"objects", std::move(object_names)},
                   {"camera", camera_json(scene.camera)},
                   {"all_solvers", all_solvers_json()},
                   {"view", view_json(scene, solvers, answers)}};

  std::string& html = result.html;
  html = page_files::html();
  put(html, "/* style */", page_files::style());
  put(html, "/* script */", page_files::script());
  put(html, "<!-- about -->", for_script(about.dump()));
  put(html, "<!-- picture -->", base64(encode_image(rendering.image, "picture.png")));
  const std::size_t left = options.most_bytes > html.size() ? options.most_bytes - html.size() : 0;
  const Replays replays =
      replays_within(left / 4 * 3, scene, solvers, answers, options.pairs, watch);
  put(html, "<!-- replays -->", base64(replays.packed));
  result.pixels = answers.shown.size();
  result.replayed = replays.pixels;
  result.complete = !watch.stopped();
  return result;
}

}  // namespace minkray
