// SPDX-License-Identifier: MIT
// Calls about pairs of shapes, robots' paths, sensors and pictures.
#include <cmath>

#include "tests/fuzz/c_abi_program.h"

namespace minkray::fuzz {

void CallProgram::distance() {
  const Given<minkray_shape> a = shape(), b = shape();
  const Given<const minkray_pose*> of_a = pose(), of_b = pose();
  Sure sure = both(both(a.sure, b.sure), both(of_a.sure, of_b.sure));
  minkray_distance_options options = {sizeof options, 0, 0, bytes_.below(2), 0};
  // At extreme proportions tight bounds take a second each under sanitizers.
  const bool has_options = bytes_.below(2) == 1 || wild_;
  if (has_options) {
    if (wild_) options.tolerance = 0.1;
    if (bytes_.below(3) == 0) options.tolerance = 1e-3;
    if (bytes_.below(3) == 0) options.at_most = bytes_.length<double>(wild_);
    if (hostile()) options.tolerance = NAN, sure = Sure::wrong;
    if (hostile()) options.at_most = -1, sure = Sure::wrong;
    if (hostile()) options.size = 1, sure = Sure::wrong;
  }
  Answers<minkray_distance> found, again;
  const auto ask = [&](Answers<minkray_distance>& to) {
    return minkray_signed_distance(a.value, of_a.value, b.value, of_b.value,
                                   has_options ? &options : nullptr, to.data());
  };
  if (!promises_.call("minkray_signed_distance", ask(found), sure, found.is_untouched())) return;
  if (ask(again) == MINKRAY_OK)
    promises_.expect(found == again, "another distance when it is asked again");
  const minkray_distance& of = found[0];
  promises_.expect(of.status >= MINKRAY_SEPARATED && of.status <= MINKRAY_UNDECIDED,
                   "a distance of no status");
  if (wild_) return;
  promises_.expect(of.lower <= of.value && of.value <= of.upper,
                   "a distance that is not between its bounds: " + std::to_string(of.lower) + ", " +
                       std::to_string(of.value) + ", " + std::to_string(of.upper));
}

void CallProgram::impact() {
  const Given<minkray_shape> a = shape(), b = shape();
  const Given<const minkray_pose*> of_a = pose(), of_b = pose();
  Sure sure = both(both(a.sure, b.sure), both(of_a.sure, of_b.sure));
  minkray_twist twist = {};
  for (double& x : twist.velocity) x = 2 * bytes_.fraction() - 1;
  if (bytes_.below(2) == 0)
    for (double& x : twist.turn) x = 2 * bytes_.fraction() - 1;
  double t_max = 4 * bytes_.fraction();
  if (hostile()) twist.turn[1] = INFINITY, sure = Sure::wrong;
  if (hostile()) t_max = bytes_.below(2) == 0 ? INFINITY : -1, sure = Sure::wrong;
  // In a unit of time 2^20 times as long, or as short, all is rounded alike.
  const double unit = std::ldexp(1.0, t_max < 2 ? 20 : -20);
  Answers<minkray_impact> found, again;
  const int code = minkray_time_of_impact(a.value, of_a.value, &twist, b.value, of_b.value, nullptr,
                                          t_max, found.data());
  if (!promises_.call("minkray_time_of_impact", code, sure, found.is_untouched())) return;
  const minkray_impact& of = found[0];
  promises_.expect(of.status >= MINKRAY_IMPACT && of.status <= MINKRAY_IMPACT_UNDECIDED,
                   "an impact of no status");
  if (!wild_)
    promises_.expect(of.t_lo <= of.t_hi && of.t_lo >= 0 && of.t_lo <= t_max,
                     "an impact at no time: " + std::to_string(of.t_lo) + ", " +
                         std::to_string(of.t_hi) + ", at most " + std::to_string(t_max));
  if (wild_) return;
  for (double& x : twist.velocity) x /= unit;
  for (double& x : twist.turn) x /= unit;
  if (minkray_time_of_impact(a.value, of_a.value, &twist, b.value, of_b.value, nullptr,
                             unit * t_max, again.data()) == MINKRAY_OK)
    promises_.expect(again[0].status == of.status && again[0].t_lo == unit * of.t_lo &&
                         again[0].t_hi == unit * of.t_hi,
                     "another impact in another unit of time: " + std::to_string(of.t_lo) + ", " +
                         std::to_string(of.t_hi) + ", times 2^" + std::to_string(std::ilogb(unit)) +
                         ": " + std::to_string(again[0].t_lo) + ", " +
                         std::to_string(again[0].t_hi));
}

void CallProgram::clearance() {
  const Given<minkray_scene> of = scene();
  HeldScene* held = model_of(of.value);
  const std::uint32_t group = bytes_.byte() % 4;
  const bool is_robot = held && group < held->groups.size() && held->groups[group].is_robot;
  Sure sure = both(of.sure, held ? held->committed : Sure::wrong);
  // The pose may be one that does not keep lengths.
  sure = both(sure, is_robot ? Sure::either : Sure::wrong);
  std::size_t numbers = is_robot ? held->groups[group].numbers : 1;
  if (hostile()) numbers += 1, sure = Sure::wrong;
  std::size_t rows = 1 + static_cast<std::size_t>(bytes_.below(3));
  std::vector<double> path;
  for (std::size_t i = 0; i < rows * numbers; ++i) path.push_back(2 * bytes_.fraction() - 1);
  if (hostile()) path[0] = NAN, sure = Sure::wrong;
  if (hostile()) rows = 0, sure = Sure::wrong;
  minkray_clearance_options options = {sizeof options, 0.3, bytes_.below(2), 1, nullptr};
  if (hostile()) options.tolerance = -1, sure = Sure::wrong;
  if (hostile()) options.threads = -1, sure = Sure::wrong;
  const std::size_t count = rows > 1 ? rows - 1 : 1;
  Answers<minkray_clearance> steps(count), least;
  const int code = minkray_scene_clearance(of.value, group, path.data(), rows, numbers, &options,
                                           steps.data(), least.data());
  if (!promises_.call("minkray_scene_clearance", code, sure,
                      steps.is_untouched() && least.is_untouched()))
    return;
  promises_.expect(steps.is_kept_behind() && least.is_kept_behind(), "a clearance too many");
  if (wild_) return;
  promises_.expect(least[0].lower <= least[0].upper, "a clearance whose bounds are crossed");
  for (std::size_t i = 0; i < count; ++i)
    promises_.expect(steps[i].lower <= steps[i].upper && steps[i].lower >= least[0].lower,
                     "a step that is nearer than the nearest");
}

void CallProgram::lidar() {
  static constexpr struct {
    const char* pattern;
    Sure sure;
  } patterns[] = {{"spinning:2x8", Sure::right},
                  {"spinning:3x5:-20,10", Sure::right},
                  {"spinning:1x1", Sure::right},
                  {"spinning:0x8", Sure::wrong},
                  {"spinning:2x8:nan,3", Sure::wrong},
                  {"spinning:2x", Sure::wrong},
                  {"spinning:999999999x999999999", Sure::wrong},
                  {"no-such-file.csv", Sure::wrong},
                  {"", Sure::wrong},
                  {nullptr, Sure::wrong}};
  const auto& chosen = patterns[bytes_.below(sizeof patterns / sizeof patterns[0])];
  const Given<const minkray_pose*> where = pose();
  const auto size = static_cast<std::size_t>(bytes_.below(24));
  Answers<minkray_ray> made(size);
  Answers<size_t> needed;
  const int code =
      minkray_lidar_rays(chosen.pattern, where.value, made.data(), size, needed.data());
  if (!promises_.call("minkray_lidar_rays", code, both(chosen.sure, where.sure),
                      made.is_untouched() && needed.is_untouched(), MINKRAY_BAD_INPUT))
    return;
  promises_.expect(made.is_kept_behind() && needed[0] > 0, "no rays, or one too many");
}

void CallProgram::picture() {
  static constexpr const char* names[] = {"rgb", "Z", "N", "id.object", "none", nullptr};
  static constexpr const char* views[] = {nullptr,
                                          R"({"camera":{"position":[0,-9,1],"look_at":[0,0,0]}})",
                                          R"({"background":[1,0.5,0]})",
                                          R"({"lights":[]})",
                                          R"({"objects":[{}]})",
                                          "{"};
  const Given<minkray_scene> of = scene();
  HeldScene* held = model_of(of.value);
  const int name = bytes_.below(6), view = bytes_.below(6);
  minkray_picture_options options = {};
  options.size = sizeof options;
  options.width = 1 + static_cast<std::uint32_t>(bytes_.below(5));
  options.height = 1 + static_cast<std::uint32_t>(bytes_.below(5));
  options.samples = 1 + static_cast<std::uint32_t>(bytes_.below(3));
  options.view = views[view];
  // An empty scene or a wild one may have nothing that can be framed.
  Sure sure = both(of.sure, Sure::either);
  if (view >= 4) sure = Sure::wrong;
  if (hostile()) options.integrator = "none", sure = Sure::wrong;
  if (hostile()) options.samples = ~0u, sure = Sure::wrong;
  if (hostile()) options.size = 0, sure = Sure::wrong;
  std::uint32_t width = 0, height = 0;
  if (promises_.call("minkray_scene_picture_size",
                     minkray_scene_picture_size(of.value, &options, &width, &height), sure, true,
                     MINKRAY_BAD_INPUT))
    promises_.expect(width == options.width && height == options.height,
                     "a picture of another size");
  Answers<std::uint32_t> numbers;
  if (!promises_.call("minkray_picture_channel",
                      minkray_picture_channel(names[name], numbers.data(), nullptr),
                      name < 3 ? Sure::right : Sure::either, numbers.is_untouched()))
    return;
  Answers<double> values(std::size_t{options.width} * options.height * numbers[0]);
  minkray_channel channel = {names[name], values.data(), values.size()};
  if (hostile()) channel.count -= 1, sure = Sure::wrong;
  const minkray_options how = {sizeof how, 1, 0, nullptr, nullptr};
  sure = both(sure, held ? held->committed : Sure::wrong);
  if (options.samples == ~0u) return;  // the size was wrong already
  if (promises_.call("minkray_scene_render",
                     minkray_scene_render(of.value, &options, &channel, 1, &how), sure,
                     values.is_untouched(), MINKRAY_BAD_INPUT))
    promises_.expect(values.is_kept_behind(), "a number too many of a picture");
}

}  // namespace minkray::fuzz
