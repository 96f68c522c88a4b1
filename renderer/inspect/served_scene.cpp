// SPDX-License-Identifier: MIT
#include "renderer/inspect/served_scene.h"

#include <atomic>
#include <cmath>

#include "core/files/text.h"
#include "core/support/named_kind.h"
#include "renderer/base/errors.h"
#include "renderer/inspect/pair_replay.h"
#include "renderer/inspect/pixel_answers.h"
#include "renderer/inspect/replay_lines.h"
#include "renderer/inspect/shape_mesh.h"
#include "renderer/io/image_file.h"
#include "renderer/paper/solvers.h"
#include "renderer/rays/camera.h"
#include "renderer/scene/scene_instances.h"

namespace minkray {
namespace {

constexpr std::size_t most_kept = 4;
constexpr int most_samples = 256;
constexpr double most_zoom = 64;
/// Limit of a requested picture's pixels, so that a reply takes seconds at most.
constexpr int most_pixels = 4'000'000;

/// Reply to an abandoned request: an unfinished picture must not look like a finished one to a
/// client that only ceased to send.
WebReply left() {
  return {503, "text/plain; charset=utf-8", "not finished: the client has closed the connection\n"};
}

double number_of(const std::string& text, const std::string& key) {
  const auto number = finite_number(text);
  if (!number) throw BadInput(key + ": must be a number");
  return *number;
}

std::vector<double> numbers_of(const std::string& text, const std::string& key, std::size_t count) {
  const auto numbers = numbers_between(text, ',');
  if (!numbers || numbers->size() != count)
    throw BadInput(key + ": must be " + std::to_string(count) + " numbers");
  return *numbers;
}

/// The watch of a reply that is abandoned when the page turns to something else. All threads call
/// it often; it checks the connection seldom.
RenderWatch until_abandoned(const RenderWatch& watch, const WebRequest& request) {
  struct State {
    std::atomic<unsigned> calls = 0;
    std::atomic<bool> is_over = false;
  };
  constexpr unsigned calls_between_looks = 32;
  const auto state = std::make_shared<State>();
  return {{}, [&watch, &request, state] {
            if (watch.stopped()) return true;
            if (state->calls++ % calls_between_looks == 0 && request.is_abandoned())
              state->is_over = true;
            return state->is_over.load();
          }};
}

}  // namespace

/// A request's values, looked up.
struct ServedScene::Asked {
  const WebRequest& request;
  CameraDescription camera;

  Asked(const WebRequest& asked, const CameraDescription& of_scene)
      : request(asked), camera(of_scene) {
    for (const auto& [key, place] : {std::pair{"eye", &camera.position}, {"at", &camera.look_at}})
      if (const std::string* text = find(key)) {
        const std::vector<double> xyz = numbers_of(*text, key, 3);
        *place = {xyz[0], xyz[1], xyz[2]};
      }
    if (!((camera.look_at - camera.position).cross(camera.up).norm() > 0))
      throw BadInput("eye: must not be at \"at\", nor straight above or below it");
  }
  const std::string* find(const std::string& key) const {
    const auto at = request.values.find(key);
    return at == request.values.end() ? nullptr : &at->second;
  }
  double number(const std::string& key, double otherwise) const {
    const std::string* const text = find(key);
    return text ? number_of(*text, key) : otherwise;
  }
  double number_within(const std::string& key, double otherwise, double least, double most) const {
    const double value = number(key, otherwise);
    if (!(value >= least && value <= most)) throw BadInput(key + ": is out of range");
    return value;
  }
};

const std::vector<InspectedSolver>& ServedScene::solvers_for(const Asked& asked) {
  CastOptions options;
  const std::string* const named = asked.find("solver");
  const std::string solver = named ? *named : solvers_.front().name;
  const double tolerance = asked.number_within("tolerance", options.eps_tol, 0, 1);
  if (solver == solvers_.front().name && tolerance == options.eps_tol) return solvers_;
  for (const Kept& kept : kept_)
    if (kept.solver == solver && kept.tolerance == tolerance) return kept.solvers;
  std::vector<InspectedSolver> made;
  const auto make = [&](const std::string& name) {
    const NamedSolver* const known = row_named(named_solvers, name);
    if (!known) throw BadInput("solver: is unknown");
    CastOptions of_solver;
    of_solver.solver = known->kind;
    of_solver.eps_tol = tolerance;
    made.push_back({name, SceneCasts(scene_, of_solver)});
  };
  make(solver);
  for (std::size_t k = 1; k < solvers_.size(); ++k) make(solvers_[k].name);
  kept_.push_front({solver, tolerance, std::move(made)});
  if (kept_.size() > most_kept) kept_.pop_back();
  return kept_.front().solvers;
}

WebReply ServedScene::cast(const Asked& asked) {
  const auto& solvers = solvers_for(asked);
  const double x = asked.number("x", 0), y = asked.number("y", 0);
  const Ray<double> ray = Camera(asked.camera, options_.picture.resolution).ray(x, y);
  const SceneCasts& first = solvers.front().casts;
  const auto shown = first.shown(ray, first.answer(ray), most_looked_at_alone);
  WebReply reply{200, "application/jsonl", ""};
  if (!shown) return reply;
  ReplayLines lines(fine_mesh);
  for (std::size_t k = 0; k < solvers.size(); ++k)
    reply.body += lines.ray(solvers[k].casts, k, *shown, {x, y, ray});
  return reply;
}

WebReply ServedScene::pair(const Asked& asked) {
  const auto object = [&](const char* key) {
    const double number = asked.number_within(key, 0, 1, double(scene_.objects.size()));
    const auto index = static_cast<std::size_t>(number) - 1;
    if (scene_.objects[index].half_space)
      throw BadInput(std::string(key) + ": must be a shape or a mesh (got a half-space)");
    return index;
  };
  auto replay = pair_json(scene_, {object("a"), object("b")});
  if (!replay) throw BadInput("a: must not lie within b, nor b within a");
  const Json line{{"kind", "pair"}, {"pair", *std::move(replay)}};
  return {200, "application/jsonl", line.dump() + "\n"};
}

WebReply ServedScene::picture(const Asked& asked) {
  RenderOptions options = options_.picture;
  options.samples = static_cast<int>(asked.number_within("samples", 1, 1, most_samples));
  const double zoom = asked.number_within("zoom", 1, 1.0 / 64, most_zoom);
  const auto zoomed = [&](int length) {
    return std::max(1, static_cast<int>(std::lround(length * zoom)));
  };
  options.resolution = {zoomed(options.resolution.width), zoomed(options.resolution.height)};
  options.crop = {0, 0, options.resolution.width, options.resolution.height};
  if (const std::string* text = asked.find("window")) {
    const std::vector<double> window = numbers_of(*text, "window", 4);
    const auto within = [](double value, int most) {
      return static_cast<int>(std::clamp(value, 0.0, double(most)));
    };
    options.crop = {
        within(window[0], options.resolution.width), within(window[1], options.resolution.height),
        within(window[2], options.resolution.width), within(window[3], options.resolution.height)};
  }
  if (options.crop.empty()) throw BadInput("window: is empty");
  if (std::int64_t{options.crop.width()} * options.crop.height() > most_pixels)
    throw BadInput("window: has too many pixels");
  Scene scene = scene_;
  scene.camera = asked.camera;
  const Rendering rendering = render(scene, solvers_for(asked).front().casts.world(), options,
                                     until_abandoned(watch_, asked.request));
  if (!rendering.complete) return left();
  const std::vector<unsigned char> png = encode_image(rendering.image, "picture.png");
  return {200, "image/png", std::string(png.begin(), png.end())};
}

WebReply ServedScene::view(const Asked& asked) {
  Scene scene = scene_;
  scene.camera = asked.camera;
  const auto& solvers = solvers_for(asked);
  std::vector<const SceneCasts*> casts;
  for (const InspectedSolver& solver : solvers) casts.push_back(&solver.casts);
  const PixelAnswers answers = measure_pixels(scene, casts, options_.picture.resolution,
                                              until_abandoned(watch_, asked.request));
  if (!answers.complete) return left();
  return {200, "application/json", view_json(scene, solvers, answers).dump()};
}

WebReply ServedScene::answer_or_throw(const WebRequest& request) {
  if (request.path.empty()) return {200, "text/html; charset=utf-8", page_};
  const Asked asked(request, scene_.camera);
  if (request.path == "cast") return cast(asked);
  if (request.path == "pair") return pair(asked);
  if (request.path == "picture") return picture(asked);
  if (request.path == "view") return view(asked);
  return {404, "text/plain; charset=utf-8", "there is nothing here\n"};
}

WebReply ServedScene::answer(const WebRequest& request) {
  try {
    return answer_or_throw(request);
  } catch (const std::runtime_error& error) {
    return {400, "text/plain; charset=utf-8", error.what() + std::string("\n")};
  }
}

}  // namespace minkray
