// SPDX-License-Identifier: MIT
#include "renderer/jobs/verify_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "renderer/film/render.h"
#include "renderer/image/text.h"
#include "renderer/scene/framing.h"

namespace minkray {
namespace {

constexpr Resolution picture_size = {960, 720};

using Rgba = std::array<double, 4>;
constexpr Rgba first_colour = {0.95, 0.45, 0.05, 1}, second_colour = {0.1, 0.4, 0.95, 1};

/// The workcell's model with the path's joint values at that time, and the two bodies in colour.
Scene scene_at(const Workcell& cell, const JointPath& path, const WorstMoment& worst) {
  Model model = cell.model;
  const Model posed = path.posed_at(worst.time);
  for (std::size_t i = 0; i < model.links.size(); ++i)
    for (std::size_t k = 0; k < model.links[i].joints.size(); ++k)
      model.links[i].joints[k].value = posed.links[i].joints[k].value;
  const std::vector<bool> chosen = chosen_geoms(model, cell.geometry);
  std::size_t body = 0;
  for (std::size_t i = 0; i < model.geoms.size(); ++i) {
    if (!chosen[i]) continue;
    if (worst.exists && body == cell.pairs[worst.pair].a) model.geoms[i].rgba = first_colour;
    if (worst.exists && body == cell.pairs[worst.pair].b) model.geoms[i].rgba = second_colour;
    ++body;
  }
  ImportOptions options;
  options.geometry = cell.geometry;
  options.picture = picture_size;
  Scene scene = scene_of(model, options, {});
  for (const Scene& other : cell.scenes) {
    const auto shift = static_cast<std::uint32_t>(scene.materials.size());
    for (const Material& material : other.materials) scene.materials.push_back(material);
    for (Object object : other.objects) {
      object.material += shift;
      scene.objects.push_back(std::move(object));
    }
  }
  frame_everything(scene, picture_size);
  return scene;
}

/// Moves the camera closer, and around the point to the view in which least is in front of it.
/// Nothing but the body of the robot, `moving`, should be: an obstacle hides what hits it.
void look_at(Scene& scene, const World& world, const Vec3<double>& point, std::size_t moving) {
  CameraDescription& camera = scene.camera;
  const Vec3<double> from = camera.position - camera.look_at;
  constexpr double nearer = 0.6;
  const double distance = nearer * from.norm(), azimuth = std::atan2(from.y(), from.x());
  constexpr int ways_round = 12;
  double best = -1;
  for (const double elevation : {0.45, 0.8, 0.15, 1.2})
    for (int k = 0; k < ways_round; ++k) {
      const double turn = azimuth + 2 * std::numbers::pi * k / ways_round;
      const Vec3<double> out(std::cos(elevation) * std::cos(turn),
                             std::cos(elevation) * std::sin(turn), std::sin(elevation));
      const Vec3<double> position = point + distance * out;
      QueryCounts counts;
      const WorldHit hit = world.closest_hit(Ray<double>{position, -distance * out, 1}, counts);
      // Ends the ray within or between the pair, so that it meets little else if nothing hides the
      // pair.
      const bool shows_robot = !hit.found() || hit.instance == moving;
      const double seen = (hit.found() ? hit.cast.t() : 1) + (shows_robot ? 1 : 0);
      if (!(seen > best + 0.02)) continue;
      best = seen;
      camera.position = position;
    }
  camera.look_at = point;
}

/// The pair's body that is a link's; objects of scene_at have the numbers of bodies.
std::size_t moving_body(const Workcell& cell, const WorstMoment& worst) {
  const RefereePair& pair = cell.pairs[worst.pair];
  return cell.bodies[pair.a].link_index >= 0 ? pair.a : pair.b;
}

}  // namespace

WorstMoment worst_moment(const MotionVerdict& verdict) {
  WorstMoment worst;
  const Stretch* deepest = nullptr;
  for (const Stretch& stretch : verdict.stretches)
    if (stretch.collides && (!deepest || stretch.upper < deepest->upper)) deepest = &stretch;
  if (deepest) return {deepest->pair, deepest->time, deepest->point, true};
  const LeastClearance& least = verdict.least;
  if (!std::isfinite(least.upper)) return worst;
  return {least.pair, least.time, (least.distance.point_a + least.distance.point_b) / 2, true};
}

Vec3<double> worst_view(const MotionVerdict& verdict, const Plan& plan, const Workcell& cell) {
  const WorstMoment worst = worst_moment(verdict);
  Scene scene = scene_at(cell, plan.path, worst);
  look_at(scene, make_world(scene), worst.point, moving_body(cell, worst));
  return scene.camera.position - scene.camera.look_at;
}

Image worst_picture(const MotionVerdict& verdict, const Plan& plan, const Workcell& cell,
                    const std::string& title, int samples) {
  WorstMoment worst = worst_moment(verdict);
  if (!worst.exists) worst.time = plan.path.times.front();
  Scene scene = scene_at(cell, plan.path, worst);
  const World world = make_world(scene);
  if (worst.exists) look_at(scene, world, worst.point, moving_body(cell, worst));
  RenderOptions options;
  options.resolution = picture_size;
  options.samples = samples;
  Image image = render(scene, world, options).image;
  const double widest = text_size(title).width;
  const double scale = std::min(2.0, (image.width - 8) / std::max(widest, 1.0));
  fill_rectangle(image, 0, 0, image.width, 14 * scale, Vec3<float>::Zero(), 0.9f);
  draw_text(image, 4 * scale, 4 * scale, title, Vec3<float>::Ones(), scale);
  return image;
}

}  // namespace minkray
