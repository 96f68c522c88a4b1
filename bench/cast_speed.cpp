// SPDX-License-Identifier: MIT
// cast-speed: nanoseconds a ray of casts in float at each shape that is measured, single and in
// packets. Uses so little of Minkray that it compiles with an earlier commit as well, which
// bench/must-hold does: `cast_speed RAYS` prints a line a shape and kind of rays.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <vector>

#if __has_include("core/cast/cast.h")
#include "core/cast/cast.h"
#include "core/cast/packet_cast.h"
#include "core/derived/convert.h"
#include "core/derived/shape_bounds.h"
#else  // before there were rooms
#include "core/shape/convert.h"
#include "core/shape/shape_bounds.h"
#include "core/solver/cast.h"
#include "core/solver/packet_cast.h"
#endif
#include "tests/support/measured_shapes.h"
#include "tests/support/random.h"

namespace {

using namespace minkray;

/// Rays that start 5 R away and aim at points of the ball of 0.6 R around the middle; none is
/// moved beforehand.
std::vector<Ray<float>> random_rays(const Ball<double>& ball, std::size_t count) {
  testing::Random random(2004);
  std::vector<Ray<float>> rays;
  while (rays.size() < count) {
    const Vec3<double> target =
        ball.centre + 0.6 * ball.radius * std::cbrt(random.uniform()) * random.direction();
    const Vec3<double> origin = ball.centre + 5 * ball.radius * random.direction();
    const Vec3<double> direction = (target - origin) / 5;
    rays.push_back({origin.cast<float>(), direction.cast<float>(), 10.0F});
  }
  return rays;
}

/// Through a picture that the ball fills, in blocks of 4 x 2 pixels.
std::vector<Ray<float>> camera_rays(const Ball<double>& ball, std::size_t count) {
  const Vec3<double> towards = Vec3<double>(-2, 3, -1).normalized();
  const Vec3<double> right = towards.unitOrthogonal(), up = towards.cross(right);
  const auto width = static_cast<std::size_t>(std::sqrt(static_cast<double>(count))) / 4 * 4;
  const double pixel = 2 * ball.radius / static_cast<double>(width);
  std::vector<Ray<float>> rays;
  for (std::size_t block = 0; rays.size() < count; ++block)
    for (std::size_t i = 0; i < 8; ++i) {
      const std::size_t x = block % (width / 4) * 4 + i % 4, y = block / (width / 4) * 2 + i / 4;
      const Vec3<double> at = ball.centre +
                              right * ((static_cast<double>(x) + 0.5) * pixel - ball.radius) +
                              up * ((static_cast<double>(y) + 0.5) * pixel - ball.radius);
      const Vec3<double> origin = ball.centre - 4 * ball.radius * towards;
      rays.push_back({origin.cast<float>(), (at - origin).normalized().cast<float>(),
                      static_cast<float>(20 * ball.radius)});
    }
  return rays;
}

/// The least of several rounds, by a ray.
template <class Cast>
double nanoseconds(std::size_t rays, const Cast& cast) {
  using Clock = std::chrono::steady_clock;
  constexpr int rounds = 15;
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const auto begin = Clock::now();
    cast();
    const std::chrono::duration<double, std::nano> time = Clock::now() - begin;
    best = std::min(best, time.count() / static_cast<double>(rays));
  }
  return best;
}

void measure(const std::string& name, const char* family, const PreparedShape<float>& shape,
             const std::vector<Ray<float>>& rays) {
  std::vector<CastResult<float>> answers(rays.size());
  const double single = nanoseconds(rays.size(), [&] {
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = cast_ray(shape, rays[i]);
  });
  constexpr auto lanes = static_cast<std::size_t>(packet_lanes<float>);
  std::vector<RayPacket<float>> packets(rays.size() / lanes);
  for (std::size_t i = 0; i < rays.size(); ++i)
    packets[i / lanes].set(static_cast<int>(i % lanes), rays[i]);
  std::vector<CastPacket<float>> together(packets.size());
  const double packet = nanoseconds(rays.size(), [&] {
    for (std::size_t i = 0; i < packets.size(); ++i)
      cast_packet(shape, packets[i], all_lanes<float>, together[i]);
  });
  std::cout << name << '\t' << family << '\t' << single << '\t' << packet << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t count = argc > 1 ? std::stoul(argv[1]) / 64 * 64 : 4096;
  for (const testing::MeasuredShape& subject : testing::measured_shapes()) {
    const Shape<float> shape = convert<float>(subject.shape);
    const PreparedShape<float> prepared(shape);
    const Ball<double> ball = ball_around(bounds_of<double>(convert<double>(shape)));
    measure(subject.name, "random", prepared, random_rays(ball, count));
    measure(subject.name, "camera", prepared, camera_rays(ball, count));
  }
}
