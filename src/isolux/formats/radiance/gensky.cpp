#include "isolux/formats/radiance/gensky.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "isolux/core/vec3.h"
#include "isolux/formats/radiance/expression.h"
#include "isolux/formats/radiance/solar_position.h"
#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace {

using std::numbers::pi;

// The formulas are those that gensky(1) documents or its output shows; radiances are W/(sr m²).
constexpr double kDegree = pi / 180;
constexpr double kSkyEfficacy = 203, kSunEfficacy = 208;  ///< lm/W, by which it turns lm into W
constexpr double kSun = 5.98e-5;                          ///< sr, the sun
constexpr double kBrightest = 1e9;                        ///< radiance

enum class Type { clear = 1, overcast = 2, uniform = 3, intermediate = 4 };

struct Options {
  SolarAngles sun;
  Type type = Type::clear;
  bool shows_sun = true;
  double ground_reflectance = 0.2;
  double turbidity = 2.45;
  std::optional<double> zenith_radiance, sky_irradiance;  ///< the latter W/m², horizontal
  std::optional<double> sun_radiance, sun_irradiance;

  bool has_sun() const { return type == Type::clear || type == Type::intermediate; }
};

double within(const Statement& s, std::size_t i, double least, double most) {
  const double value = s.number(i);
  if (value >= least && value <= most) return value;
  s.fail(i, fmt::format("must lie between {} and {}, but is {}", least, most, value));
}

Options read_options(const Statement& s) {
  s.expect_arguments(3, Statement::kAnyNumber,
                     "gensky month day hour, or gensky -ang altitude azimuth");
  Options options;
  Site site;
  std::optional<int> year;
  for (std::size_t i = 4; i < s.size(); ++i) {
    const std::string_view option = s.word(i);
    const auto value = [&] {
      if (i + 1 == s.size()) s.fail(i, fmt::format("{} needs a number", in_quotes(option)));
      return ++i;
    };
    if (option == "-s" || option == "+s" || option == "-i" || option == "+i") {
      options.type = option[1] == 's' ? Type::clear : Type::intermediate;
      options.shows_sun = option[0] == '+';
    } else if (option == "-c" || option == "+c") {
      options.type = Type::overcast;
    } else if (option == "-u" || option == "+u") {
      options.type = Type::uniform;
    } else if (option == "-g") {
      options.ground_reflectance = within(s, value(), 0, 1);
    } else if (option == "-t") {
      options.turbidity = s.number_of_at_least_0(value());
    } else if (option == "-b" || option == "-B") {
      const double given = s.number_of_at_least_0(value());
      options.zenith_radiance.reset(), options.sky_irradiance.reset();
      (option == "-b" ? options.zenith_radiance : options.sky_irradiance) = given;
    } else if (option == "-r" || option == "-R") {
      const double given = s.number_of_at_least_0(value());
      options.sun_radiance.reset(), options.sun_irradiance.reset();
      (option == "-r" ? options.sun_radiance : options.sun_irradiance) = given;
    } else if (option == "-a") {
      site.latitude = within(s, value(), -90, 90) * kDegree;
    } else if (option == "-o") {
      site.longitude = within(s, value(), -360, 360) * kDegree;
    } else if (option == "-m") {
      site.meridian = within(s, value(), -360, 360) * kDegree;
    } else if (option == "-y") {
      year = s.integer(value(), 1901, 2099);
    } else {
      throw Unsupported{fmt::format("the option {}", in_quotes(option))};
    }
  }
  if (s.word(1) == "-ang") {
    options.sun = {within(s, 2, -90, 90) * kDegree, within(s, 3, -360, 360) * kDegree};
  } else {
    options.sun =
        solar_angles(year, s.integer(1, 1, 12), s.integer(2, 1, 31), read_time(s, 3), site);
  }
  return options;
}

/// The value of a sky's function (SkyPattern) in the zenith, as gensky has it.
double normalization(const Options& options) {
  const double from_zenith = pi / 2 - options.sun.altitude, sine = std::sin(options.sun.altitude);
  if (options.type == Type::clear) {
    return 0.274 * (0.91 + 10 * std::exp(-3 * from_zenith) + 0.45 * sine * sine);
  }
  return (2.739 + 0.9891 * std::sin(0.3119 + 2.6 * options.sun.altitude)) *
         std::exp(-from_zenith * (0.4441 + 1.48 * options.sun.altitude));
}

/// The horizontal irradiance by the sky over π, in parts of the radiance in its zenith.
double mean_over_zenith(const Options& options) {
  if (options.type == Type::uniform) return 1;
  if (options.type == Type::overcast) return 7.0 / 9;
  constexpr double kFits[2][5] = {{2.766521, 0.547665, -0.369832, 0.009237, 0.059229},
                                  {3.5556, -2.7152, -1.3081, 1.0660, 0.60227}};
  const double x = options.sun.altitude / (pi / 4) - 1;
  const auto& fit = kFits[options.type == Type::intermediate];
  const double sum = fit[0] + x * (fit[1] + x * (fit[2] + x * (fit[3] + x * fit[4])));
  return sum / normalization(options) / pi;
}

double zenith_radiance(const Options& options) {
  if (options.zenith_radiance) return *options.zenith_radiance;
  if (options.sky_irradiance) return *options.sky_irradiance / (pi * mean_over_zenith(options));
  // Luminances, kcd/m².
  const double overcast = 8.6 * std::sin(options.sun.altitude) + 0.123;
  const double clear = (1.376 * options.turbidity - 1.81) * std::tan(options.sun.altitude) + 0.38;
  const double luminance = !options.has_sun()            ? overcast
                           : options.type == Type::clear ? clear
                                                         : (clear + overcast) / 2;
  return std::max(0.0, luminance * 1000 / kSkyEfficacy);
}

/// That of the sun, 0 where there is none.
double sun_radiance(const Options& options) {
  const double sine = std::sin(options.sun.altitude);
  if (!options.has_sun() || !(sine > 0)) return 0;
  if (options.sun_radiance) return *options.sun_radiance;
  if (options.sun_irradiance) return *options.sun_irradiance / (kSun * sine);
  const double clear = 1.5e9 / kSunEfficacy * (1.147 - 0.147 / std::max(sine, 0.16));
  return options.type == Type::clear ? clear : 0.15 * clear;
}

}  // namespace

std::string generate_sky(const Statement& s, Notes& notes) {
  constexpr double kHighest = 87 * kDegree;  // that of a sun in a sky with one
  Options options = read_options(s);
  SolarAngles& angles = options.sun;
  if (options.has_sun() && angles.altitude > kHighest) {
    angles.altitude = kHighest;
    notes.add("gensky: the sun is lowered to 87 degrees above the horizon, as its skies need");
  }
  const Vec3 sun{-std::sin(angles.azimuth) * std::cos(angles.altitude),
                 -std::cos(angles.azimuth) * std::cos(angles.altitude), std::sin(angles.altitude)};
  const double radiance = sun_radiance(options), zenith = zenith_radiance(options);
  const double ground = options.ground_reflectance *
                        (zenith * mean_over_zenith(options) + 6e-5 / pi * radiance * sun.z);
  if (!(std::max({radiance, zenith, ground}) <= kBrightest)) {
    s.fail(0, fmt::format("this sky would be brighter than {:g} W/(sr m²)", kBrightest));
  }
  std::string text;
  const auto out = std::back_inserter(text);
  if (radiance > 0 && options.shows_sun) {
    fmt::format_to(out, "void light solar 0 0 3 {0} {0} {0}\n", radiance);
    fmt::format_to(out, "solar source sun 0 0 4 {} {} {} 0.5\n", sun.x, sun.y, sun.z);
  }
  fmt::format_to(out, "void brightfunc skyfunc 2 skybr skybright.cal 0 ");
  const int type = static_cast<int>(options.type);
  if (options.has_sun()) {
    fmt::format_to(out, "7 {} {} {} {} {} {} {}\n", type, zenith, ground, normalization(options),
                   sun.x, sun.y, sun.z);
  } else {
    fmt::format_to(out, "3 {} {} {}\n", type, zenith, ground);
  }
  return text;
}

}  // namespace isolux::radiance
