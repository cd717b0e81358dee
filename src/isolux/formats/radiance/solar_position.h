#pragma once

#include <optional>

#include "isolux/formats/statement.h"

namespace isolux::radiance {

/// Where gensky is, as it has it without options; radians.
struct Site {
  double latitude = 0.66;                ///< north
  double longitude = 2.13;               ///< west
  double meridian = 2.0943951023931953;  ///< of the time zone, west: 120 degrees
};

/// A time of the day as gensky takes it: "13", "13.5", "13:30", "13:30EST", "+13:30".
struct ClockTime {
  double hours = 0;
  bool solar = false;              ///< the sun is highest at 12
  std::optional<double> meridian;  ///< that of the zone that the time names, rad west
};

/// Reads word i. Throws InputError with the place where it is no such time.
ClockTime read_time(const Statement& s, std::size_t i);

struct SolarAngles {
  double altitude = 0;  ///< above the horizon, rad
  double azimuth = 0;   ///< west of south, rad
};

/// Where the sun is, month and day counting from 1. Without a year by the formulas of the IES
/// Lighting Handbook; with one (1901 to 2099) by the Astronomical Almanac's approximation
/// (Michalsky, Solar Energy 40, 1988).
SolarAngles solar_angles(std::optional<int> year, int month, int day, const ClockTime& time,
                         const Site& site);

}  // namespace isolux::radiance
