// SPDX-License-Identifier: MIT
#include "renderer/scene/sun_position.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/files/text.h"

namespace minkray {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Removes `digits` digits from the beginning of a text; -1 if there are fewer.
int take_digits(std::string_view& text, std::size_t digits) {
  int number = -1;
  if (text.size() < digits || !read_number(text.substr(0, digits), number) || number < 0) return -1;
  text.remove_prefix(digits);
  return number;
}

bool take(std::string_view& text, char c) {
  if (text.empty() || text.front() != c) return false;
  text.remove_prefix(1);
  return true;
}

int days_of_month(int year, int month) {
  constexpr std::array days = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return days[static_cast<std::size_t>(month - 1)] + (month == 2 && is_leap ? 1 : 0);
}

/// Days from 1 January 2000 to a date of the Gregorian calendar.
int days_of_date(int year, int month, int day) {
  // Years begin in March, so that leap days come last.
  const int y = month > 2 ? year : year - 1, m = (month + 9) % 12;
  const int since_march = (153 * m + 2) / 5 + day - 1;
  const auto days = [](int of) { return 365 * of + of / 4 - of / 100 + of / 400; };
  return days(y) + since_march - (days(1999) + 306);
}

/// Minutes of "Z", "+02:00", "-05:30", nothing else behind it.
std::optional<int> zone(std::string_view text) {
  if (text == "Z") return 0;
  const bool is_west = take(text, '-');
  if (!is_west && !take(text, '+')) return std::nullopt;
  const int hours = take_digits(text, 2);
  const bool has_colon = take(text, ':');
  const int minutes = take_digits(text, 2);
  if (hours < 0 || hours > 14 || !has_colon || minutes < 0 || minutes > 59 || !text.empty())
    return std::nullopt;
  return (is_west ? -1 : 1) * (60 * hours + minutes);
}

}  // namespace

std::optional<double> days_since_2000(const std::string& time) {
  std::string_view text = time;
  const int year = take_digits(text, 4);
  bool is_well_formed = take(text, '-');
  const int month = take_digits(text, 2);
  is_well_formed = is_well_formed && take(text, '-');
  const int day = take_digits(text, 2);
  is_well_formed = is_well_formed && take(text, 'T');
  const int hour = take_digits(text, 2);
  is_well_formed = is_well_formed && take(text, ':');
  const int minute = take_digits(text, 2);
  const int second = take(text, ':') ? take_digits(text, 2) : 0;
  if (!is_well_formed || year < 1583 || month < 1 || month > 12 || day < 1 ||
      day > days_of_month(year, month) || hour < 0 || hour > 23 || minute < 0 || minute > 59 ||
      second < 0 || second > 59)
    return std::nullopt;
  const std::optional<int> ahead = zone(text);
  if (!ahead) return std::nullopt;
  const double seconds = 3600.0 * hour + 60.0 * (minute - *ahead) + second;
  return days_of_date(year, month, day) - 0.5 + seconds / 86400;
}

Vec3<double> direction_of_sun(double days_since_2000, double latitude_degrees,
                              double longitude_degrees) {
  const double n = days_since_2000;
  const double mean_longitude = 280.460 + 0.9856474 * n;
  const double g = (357.528 + 0.9856003 * n) * degree;  // mean anomaly
  const double lambda = (mean_longitude + 1.915 * std::sin(g) + 0.020 * std::sin(2 * g)) * degree;
  const double obliquity = (23.439 - 0.0000004 * n) * degree;
  const double right_ascension =
      std::atan2(std::cos(obliquity) * std::sin(lambda), std::cos(lambda));
  const double declination = std::asin(std::sin(obliquity) * std::sin(lambda));

  const double hours = 24 * (n + 0.5 - std::floor(n + 0.5));  // universal time
  const double sidereal_hours = 6.697375 + 0.0657098242 * n + hours;
  const double hour_angle = (15 * sidereal_hours + longitude_degrees) * degree - right_ascension;

  const double latitude = latitude_degrees * degree;
  const double towards_south = std::cos(declination) * std::cos(hour_angle);
  return {-std::cos(declination) * std::sin(hour_angle),
          std::sin(declination) * std::cos(latitude) - towards_south * std::sin(latitude),
          std::sin(declination) * std::sin(latitude) + towards_south * std::cos(latitude)};
}

}  // namespace minkray
