#include "isolux/solution/metadata.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "isolux/core/error.h"
#include "isolux/radiosity/solve.h"
#include "isolux/solution/glb.h"

namespace isolux {
namespace {

using nlohmann::json;

/// Calls f(name, member) for every option: the one list that saving and loading share.
template <typename AnyOptions, typename F>
void for_each_option(AnyOptions& options, F&& f) {
  f("method", options.method);
  f("tolerance", options.tolerance);
  f("max_triangles", options.max_triangles);
  f("max_edge", options.rules.max_edge);
  f("min_area", options.rules.min_area);
  f("normal_tolerance", options.rules.normal_tolerance);
  f("contrast", options.contrast);
  f("iterations", options.iterations);
  f("stop_at_unshot", options.stop_at_unshot);
  f("grid", options.grid);
  f("least_rays", options.least_rays);
  f("distribution", options.distribution);
  f("eye_grid", options.eye_grid);
  f("pairing_tolerance", options.pairing_tolerance);
  f("subdivisions", options.subdivisions);
  f("selection", options.selection);
  f("refine", options.refine);
  f("camera", options.camera);
  f("seed", options.seed);
}

template <typename AnyStatistics, typename F>
void for_each_statistic(AnyStatistics& statistics, F&& f) {
  f("iterations", statistics.iterations);
  f("converged", statistics.converged);
  f("interrupted", statistics.interrupted);
  f("triangles", statistics.triangles);
  f("vertices", statistics.vertices);
  f("removed", statistics.removed);
  f("extended", statistics.extended);
  f("split", statistics.split);
  f("refinement_rays", statistics.refinement_rays);
  f("shadow_rays", statistics.shadow_rays);
  f("emitted_flux", statistics.emitted_flux);
  f("unshot_flux", statistics.unshot_flux);
  f("ambient_exitance", statistics.ambient_exitance);
  f("mesh_area", statistics.mesh_area);
  f("gather_rays", statistics.gather_rays);
  f("gatherers", statistics.gatherers);
  f("absorbed_flux", statistics.absorbed_flux);
  f("escaped_flux", statistics.escaped_flux);
  f("imbalance", statistics.imbalance);
  f("mean_irradiance", statistics.mean_irradiance);
  f("error", statistics.error);
  f("discretization_error", statistics.discretization_error);
  f("narrow_error", statistics.narrow_error);
  f("sampling_error", statistics.sampling_error);
  f("emitter_error", statistics.emitter_error);
}

const char* name_of(Method m) { return m == Method::shooting ? "shooting" : "gathering"; }
const char* name_of(Selection s) { return s == Selection::power ? "power" : "radiosity"; }
const char* name_of(Distribution d) { return d == Distribution::malley ? "malley" : "uniform"; }

struct Write {
  json& object;

  template <typename T>
  void operator()(const char* key, const T& value) const {
    if constexpr (std::is_enum_v<T>) {
      object[key] = name_of(value);
    } else {
      object[key] = value;
    }
  }
};

struct Read {
  const json& object;

  void operator()(const char* key, double& value) const {
    const json& j = member(object, key);
    if (!j.is_number() || !std::isfinite(j.get<double>())) reject(key, "a number");
    value = j.get<double>();
  }
  void operator()(const char* key, int& value) const {
    constexpr auto kMax = static_cast<std::uint64_t>(std::numeric_limits<int>::max());
    value = static_cast<int>(integer_member(object, key, kMax));
  }
  void operator()(const char* key, std::uint64_t& value) const {
    value = integer_member(object, key, std::numeric_limits<std::uint64_t>::max());
  }
  void operator()(const char* key, bool& value) const {
    const json& j = member(object, key);
    if (!j.is_boolean()) reject(key, "true or false");
    value = j.get<bool>();
  }
  void operator()(const char* key, std::string& value) const {
    const json& j = member(object, key);
    if (!j.is_string()) reject(key, "a text");
    value = j.get<std::string>();
  }
  void operator()(const char* key, Method& value) const {
    choose(key, value, Method::gathering, Method::shooting);
  }
  void operator()(const char* key, Selection& value) const {
    choose(key, value, Selection::radiosity, Selection::power);
  }
  void operator()(const char* key, Distribution& value) const {
    choose(key, value, Distribution::uniform, Distribution::malley);
  }

  template <typename Choice>
  void choose(const char* key, Choice& value, Choice a, Choice b) const {
    std::string name;
    (*this)(key, name);
    if (name != name_of(a) && name != name_of(b)) reject(key, "a known choice");
    value = name == name_of(a) ? a : b;
  }
  [[noreturn]] static void reject(const char* key, const char* expected) {
    throw InputError(fmt::format("is damaged: '{}' is not {}", key, expected));
  }
};

}  // namespace

json options_to_json(const Options& options) {
  json object = json::object();
  for_each_option(options, Write{object});
  return object;
}

Options options_from_json(const json& object) {
  Options options;
  for_each_option(options, Read{object});
  try {
    check_options(options);
  } catch (const InputError& error) {
    throw InputError(fmt::format("is damaged: {}", error.what()));
  }
  return options;
}

json statistics_to_json(const Statistics& statistics) {
  json object = json::object();
  for_each_statistic(statistics, Write{object});
  return object;
}

Statistics statistics_from_json(const json& object) {
  Statistics statistics;
  for_each_statistic(statistics, Read{object});
  return statistics;
}

}  // namespace isolux
