// SPDX-License-Identifier: MIT
// Wrong input of every sort: each is an error, and the same one each time.
#include <cmath>
#include <limits>

#include "tests/soak/work.h"

namespace soak {
namespace {

/// Messages contain no number of a handle: those are never given out again.
template <class Call>
void refused(Answers& answers, Call&& call, bool with_text = true) {
  try {
    call();
  } catch (const mk::Error& error) {
    answers.add(error.code());
    if (with_text) answers.add_text(error.what());
    return;
  }
  throw std::runtime_error("a mistake must be an error");
}

}  // namespace

void mistakes(const Common& common, Answers& answers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  // Shapes that cannot be.
  refused(answers, [] { mk::sphere(-1); });
  refused(answers, [&] { mk::box({1, nan, 1}); });
  refused(answers, [] { mk::hull({}); });
  refused(answers, [] { mk::make("ball", {}); });
  refused(answers, [] { mk::scaled(mk::sphere(1), mk::Vec3{1, 0, 1}); });
  refused(answers, [] { mk::read_shape(R"({"type": "sphere", "radius": )"); });
  refused(answers, [] { mk::read_shape(R"({"type": "sphere", "radios": 1})"); });

  // Support functions that are none.
  refused(answers, [] { mk::custom([](const mk::Vec3& n) { return mk::Vec3{-n.x, n.y, n.z}; }); });
  refused(answers,
          [] { mk::custom([](const mk::Vec3&) -> mk::Vec3 { throw std::runtime_error("no"); }); });

  // Files that are not there, or something else.
  mk::Scene scene;
  refused(answers, [&] { scene.add_file("no-such-file.json"); });
  refused(
      answers, [&] { scene.add_file(source_file("examples/first_ray.cpp")); }, false);
  refused(answers, [&] { scene.set_pose(3, mk::identity()); });
  scene.add(mk::sphere(1));
  refused(answers, [&] { scene.cast({{0, 0, 5}, {0, 0, -1}}); });  // not committed
  scene.commit();
  refused(answers, [&] { scene.cast({{0, 0, 5}, {0, 0, nan}}); });
  refused(answers, [&] { scene.exit(9, {{0, 0, 5}, {0, 0, -1}}); });
  refused(answers, [&] { mk::lidar("spinning:0x0", mk::identity()); });
  answers.add(scene.cast({{0, 0, 5}, {0, 0, -1}}));  // none of them did it any harm

  // Impossible pictures, of the scene that the others are querying.
  double light[12];
  const mk::Channel channel[] = {{"rgb", light, 12}}, unknown[] = {{"red", light, 12}};
  mk::PictureOptions options;
  options.width = options.height = 2;
  refused(answers, [&] { common.scene.render(options, unknown); });
  options.view = R"({"camera": {"position": 1}})";
  refused(answers, [&] { common.scene.render(options, channel); });

  // A shape that is gone; the number of one that never was.
  const minkray_shape gone = [] {
    const mk::Shape shape = mk::sphere(1);
    return shape.handle();
  }();
  refused(
      answers, [&] { mk::detail::check(minkray_shape_release(gone)); }, false);
}

}  // namespace soak
