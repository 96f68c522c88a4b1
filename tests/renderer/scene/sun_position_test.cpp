// SPDX-License-Identifier: MIT
// Compares the position of the sun with published ones.
#include "renderer/scene/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace minkray {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Precision of the formulas, in degrees, and the air's refraction where a reference includes it.
constexpr double precision = 0.02, refraction = 0.017;

struct Place {
  double zenith, azimuth;  ///< in degrees, azimuths from north by east
};

Place sun(const std::string& time, double latitude, double longitude) {
  const auto days = days_since_2000(time);
  EXPECT_TRUE(days) << time;
  const Vec3<double> d = direction_of_sun(days.value_or(0), latitude, longitude);
  EXPECT_NEAR(d.norm(), 1, 1e-12);
  const double azimuth = std::atan2(d.x(), d.y()) / degree;
  return {std::acos(d.z()) / degree, azimuth < 0 ? azimuth + 360 : azimuth};
}

// The example of Reda and Andreas, "Solar Position Algorithm for Solar Radiation Applications"
// (NREL/TP-560-34302), Golden, Colorado.
TEST(SunPosition, is_that_of_the_solar_position_algorithms_example) {
  const Place place = sun("2003-10-17T12:30:30-07:00", 39.742476, -105.1786);
  EXPECT_NEAR(place.zenith, 50.11162, precision + refraction);
  EXPECT_NEAR(place.azimuth, 194.34024, precision);
}

// At the June solstice of 2020 (20 June, 21:44) the sun was above the tropic.
TEST(SunPosition, at_the_solstice_it_stands_above_the_tropic) {
  const auto days = days_since_2000("2020-06-20T21:44Z");
  ASSERT_TRUE(days);
  double least = 90;
  for (double longitude = -180; longitude < 180; longitude += 0.05)
    least = std::min(least, std::acos(direction_of_sun(*days, 23.437, longitude).z()) / degree);
  EXPECT_LT(least, precision + 0.025);
}

TEST(SunPosition, mornings_are_east_and_evenings_west_and_southern_suns_in_the_north) {
  EXPECT_LT(sun("2026-03-20T07:00Z", 51, 0).azimuth, 180);
  EXPECT_GT(sun("2026-03-20T17:00Z", 51, 0).azimuth, 180);
  EXPECT_NEAR(sun("2026-03-20T12:08Z", 51, 0).azimuth, 180, 1);
  const double north = sun("2026-12-21T02:00Z", -33.87, 151.2).azimuth;  // Sydney, about noon
  EXPECT_TRUE(north < 30 || north > 330) << north;
}

TEST(SunPosition, times_are_read_strictly_and_zones_are_hours) {
  EXPECT_EQ(days_since_2000("2000-01-01T12:00Z"), 0.0);
  EXPECT_EQ(days_since_2000("2000-01-01T12:00:00Z"), 0.0);
  EXPECT_EQ(days_since_2000("2000-03-01T12:00Z"), 60.0);
  EXPECT_EQ(days_since_2000("2001-01-01T00:00Z"), 365.5);
  EXPECT_EQ(days_since_2000("1999-12-31T12:00Z"), -1.0);
  EXPECT_EQ(days_since_2000("2000-01-01T14:00+02:00"), 0.0);
  EXPECT_EQ(days_since_2000("2000-01-01T06:30-05:30"), 0.0);
  for (const char* text :
       {"", "2000-01-01", "2000-01-01T12:00", "2000-02-30T12:00Z", "1900-02-29T12:00Z",
        "2000-13-01T12:00Z", "2000-01-01T24:00Z", "2000-01-01T12:60Z", "2000-01-01T12:00+2",
        "2000-01-01T12:00ZZ", "2000-1-01T12:00Z", "2000-01-01 12:00Z", "-200-01-01T12:00Z"})
    EXPECT_FALSE(days_since_2000(text)) << text;
}

}  // namespace
}  // namespace minkray
