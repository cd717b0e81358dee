#include "isolux/formats/radiance/solar_position.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include "isolux/scene/length.h"
#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace {

using std::numbers::pi;

constexpr double kDegree = pi / 180;

struct Zone {
  std::string_view name;
  double meridian;  ///< degrees west
};

/// As gensky(1) lists them; names that it has twice mean the first.
constexpr Zone kZones[] = {
    {"YST", 135},  {"YDT", 120},  {"PST", 120},   {"PDT", 105},   {"MST", 105},   {"MDT", 90},
    {"CST", 90},   {"CDT", 75},   {"EST", 75},    {"EDT", 60},    {"AST", 60},    {"ADT", 45},
    {"NST", 52.5}, {"NDT", 37.5}, {"GMT", 0},     {"BST", -15},   {"CET", -15},   {"CEST", -30},
    {"EET", -30},  {"EEST", -45}, {"GST", -60},   {"GDT", -75},   {"IST", -82.5}, {"IDT", -97.5},
    {"JST", -135}, {"JDT", -150}, {"NZST", -180}, {"NZDT", -195},
};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// Counting from 1, in a year without a leap day.
int day_of_year(int month, int day) {
  constexpr std::array kDays = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
  return kDays.at(static_cast<std::size_t>(month - 1)) + day;
}

struct Declination {
  double declination;  ///< rad
  double solar_time;   ///< hours
};

/// The formulas of the IES Lighting Handbook; `day` is that of the year.
Declination handbook(int day, double hours, const Site& site) {
  const double equation_of_time =
      0.170 * std::sin(4 * pi / 373 * (day - 80)) - 0.129 * std::sin(2 * pi / 355 * (day - 8));
  return {0.4093 * std::sin(2 * pi / 365 * (day - 81)),
          hours + equation_of_time + 12 / pi * (site.meridian - site.longitude)};
}

/// Michalsky 1988, the sun's ecliptic longitude to 0.01 degrees between 1950 and 2050.
Declination almanac(int year, int month, int day, double hours, const Site& site) {
  const int years = year - 1949;
  const int leap_days = static_cast<int>(std::floor(years / 4.0)) + (month > 2 && year % 4 == 0);
  const double universal = hours + site.meridian * 12 / pi;
  // Days since noon of the first of January 2000; 1949 began on Julian day 2432916.5, less one.
  const double n =
      day_of_year(month, day) + 365.0 * years + leap_days + universal / 24 + (2432916.5 - 2451545);
  const double mean_longitude = (280.460 + 0.9856474 * n) * kDegree;
  const double anomaly = (357.528 + 0.9856003 * n) * kDegree;
  const double longitude = mean_longitude + 1.915 * kDegree * std::sin(anomaly) +
                           0.020 * kDegree * std::sin(2 * anomaly);
  const double obliquity = (23.439 - 4e-7 * n) * kDegree;
  const double right_ascension =
      std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
  // Sidereal time of the place; the sun's hour angle is that less its right ascension.
  const double sidereal = 6.697375 + 0.0657098242 * n + universal - site.longitude * 12 / pi;
  const double solar_time = sidereal - right_ascension * 12 / pi + 12;
  return {std::asin(std::sin(obliquity) * std::sin(longitude)),
          solar_time - 24 * std::floor(solar_time / 24)};
}

}  // namespace

ClockTime read_time(const Statement& s, std::size_t i) {
  std::string_view text = s.word(i);
  ClockTime time;
  time.solar = text.starts_with('+');
  if (time.solar) text.remove_prefix(1);
  const auto letters = std::find_if(text.begin(), text.end(), is_letter);
  const std::string_view clock = text.substr(0, static_cast<std::size_t>(letters - text.begin()));
  std::string zone(text.substr(clock.size()));
  const std::size_t colon = clock.find(':');
  const auto hours = parse_number(clock.substr(0, colon));
  const auto minutes =
      colon == clock.npos ? std::optional(0.0) : parse_number(clock.substr(colon + 1));
  if (!hours || !minutes || !(*minutes >= 0 && *minutes < 60) || (time.solar && !zone.empty())) {
    s.fail(i, fmt::format("expected a time such as 13:30, 13.5EST or +12 (solar), not {}",
                          in_quotes(s.word(i))));
  }
  time.hours = *hours + *minutes / 60;
  if (!(time.hours >= 0 && time.hours <= 24)) s.fail(i, "the hour must lie between 0 and 24");
  if (zone.empty()) return time;
  std::transform(zone.begin(), zone.end(), zone.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::vector<std::string_view> known;
  for (const Zone& entry : kZones) {
    if (entry.name == zone) time.meridian = entry.meridian * kDegree;
    known.push_back(entry.name);
  }
  if (!time.meridian) {
    s.fail(i, fmt::format("unknown time zone {}: {}", in_quotes(zone), suggestion(zone, known)));
  }
  return time;
}

SolarAngles solar_angles(std::optional<int> year, int month, int day, const ClockTime& time,
                         const Site& given) {
  Site site = given;
  if (time.meridian) site.meridian = *time.meridian;
  const Declination sun = year ? almanac(*year, month, day, time.hours, site)
                               : handbook(day_of_year(month, day), time.hours, site);
  const double hour_angle = ((time.solar ? time.hours : sun.solar_time) - 12) * pi / 12;
  const double d = sun.declination, l = site.latitude, h = hour_angle;
  const double up = std::sin(l) * std::sin(d) + std::cos(l) * std::cos(d) * std::cos(h);
  const double west = std::cos(d) * std::sin(h);
  const double south = std::sin(l) * std::cos(d) * std::cos(h) - std::cos(l) * std::sin(d);
  return {std::asin(std::clamp(up, -1.0, 1.0)), std::atan2(west, south)};
}

}  // namespace isolux::radiance
