#pragma once

#include <nlohmann/json.hpp>

#include "isolux/radiosity/options.h"
#include "isolux/radiosity/statistics.h"

namespace isolux {

/// The options as a JSON object, one member for each.
nlohmann::json options_to_json(const Options& options);

/// Throws InputError (without a location) where a member is missing, of the wrong type, or not a
/// number that a solve could have used.
Options options_from_json(const nlohmann::json& object);

/// The same for statistics. The seconds are left out: they differ between equal solves.
nlohmann::json statistics_to_json(const Statistics& statistics);
Statistics statistics_from_json(const nlohmann::json& object);

}  // namespace isolux
