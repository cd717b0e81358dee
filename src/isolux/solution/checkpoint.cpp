#include "isolux/solution/checkpoint.h"

#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <type_traits>

#include <algorithm>

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/core/version.h"
#include "isolux/radiosity/gathering.h"
#include "isolux/radiosity/hemisphere_gather.h"
#include "isolux/solution/glb.h"
#include "isolux/solution/metadata.h"

namespace isolux {
namespace {

using nlohmann::json;

constexpr const char* kFormat = "isolux checkpoint 7";

[[noreturn]] void damaged(const char* key) {
  throw InputError(fmt::format("is damaged: '{}' is missing or makes no sense", key));
}

/// The numbers of a vertex that are not lists.
struct PackedVertex {
  Vec3 position, normal, gather_point;
  Rgb reflectance, irradiance, delta_irradiance, mean_irradiance;
  double error = 0;
  SurfaceId surface;
  std::uint32_t on_light = 0, neighbours = 0, triangles = 0;  // lengths of lists, the last two
  std::uint32_t hidden = 0;
};

struct PackedTriangle {
  Vec3 normal;
  double area = 0;
  Rgb emission, shot;
  std::array<VertexId, 3> vertices{};
  std::uint16_t alive = 0, on_light = 0;
};

struct PackedLight {
  Rgb direct, indirect;
  double direct_deviation = 0, indirect_deviation = 0, own_bend = 0, bend = 0, escaped = 0,
         excess = 0, glimpse = 0, glimpse_deviation = 0;
  MeshPlace among;
  Rgb beyond;
  std::uint32_t depth = 0, gathers = 0, grid = 0, kept_grid = 0, divided = 0, rays = 0;
  std::uint64_t links = 0;
};

struct PackedError {
  std::uint64_t edge = 0;
  float error = 0;
  std::uint32_t unused = 0;
};

struct PackedFinding {
  std::uint64_t edge = 0;
  EdgeFinding finding;
};

struct PackedMiddle {
  std::uint64_t edge = 0;
  MiddleLight light;
  std::uint32_t unused = 0;
};

/// The scalars of a state, for writing and reading alike.
template <typename State, typename F>
void for_each_scalar(State& state, F&& f) {
  f("level", state.level);
  f("direct_mean_square", state.direct_mean_square);
  f("indirect_mean_square", state.indirect_mean_square);
  f("narrow_mean_square", state.narrow_mean_square);
  f("bend_scale", state.bend_scale);
  f("edge_scale", state.edge_scale);
  f("found", state.found);
  f("foreseen", state.foreseen);
  f("lean", state.lean);
  f("bias", state.bias);
  f("mean_importance", state.mean_importance);
  f("balance_r", state.balance.r);
  f("balance_g", state.balance.g);
  f("balance_b", state.balance.b);
}

template <typename T>
void put(json& object, const char* key, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  object[key] = json::binary(std::move(bytes));
}

template <typename T>
std::vector<T> get(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_binary()) damaged(key);
  const auto& bytes = found->get_binary();
  if (bytes.size() % sizeof(T) != 0) damaged(key);
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

/// Takes `count` values off the front of a flattened list.
template <typename T>
std::vector<T> take(const std::vector<T>& all, std::size_t& at, std::size_t count,
                    const char* key) {
  if (count > all.size() - at) damaged(key);
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(at);
  at += count;
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

json mesh_to_json(const Triangulation& mesh) {
  std::vector<PackedVertex> vertices;
  std::vector<std::uint32_t> neighbours, around;
  for (const Vertex& v : mesh.vertices()) {
    vertices.push_back({v.position, v.normal, v.gather_point, v.reflectance, v.irradiance,
                        v.delta_irradiance, v.mean_irradiance, v.error, v.surface, v.on_light,
                        static_cast<std::uint32_t>(v.neighbours.size()),
                        static_cast<std::uint32_t>(v.triangles.size()), v.hidden});
    neighbours.insert(neighbours.end(), v.neighbours.begin(), v.neighbours.end());
    around.insert(around.end(), v.triangles.begin(), v.triangles.end());
  }
  std::vector<PackedTriangle> triangles;
  for (const Triangle& t : mesh.triangles()) {
    triangles.push_back({t.normal, t.area, t.emission, t.shot, t.vertices, t.alive, t.on_light});
  }
  json object;
  put(object, "vertices", vertices);
  put(object, "neighbours", neighbours);
  put(object, "around", around);
  put(object, "triangles", triangles);
  return object;
}

Triangulation mesh_from_json(const json& object, const Rules& rules, const Bounds& bounds) {
  const auto neighbours = get<std::uint32_t>(object, "neighbours");
  const auto around = get<std::uint32_t>(object, "around");
  std::size_t next_neighbour = 0, next_around = 0;
  std::vector<Vertex> vertices;
  for (const PackedVertex& p : get<PackedVertex>(object, "vertices")) {
    Vertex v;
    static_cast<SurfacePoint&>(v) = {p.position, p.normal, p.surface, p.reflectance};
    v.gather_point = p.gather_point;
    v.irradiance = p.irradiance;
    v.delta_irradiance = p.delta_irradiance;
    v.mean_irradiance = p.mean_irradiance;
    v.error = p.error;
    v.on_light = p.on_light != 0;
    v.hidden = p.hidden != 0;
    v.neighbours = take(neighbours, next_neighbour, p.neighbours, "neighbours");
    v.triangles = take(around, next_around, p.triangles, "around");
    vertices.push_back(std::move(v));
  }
  std::vector<Triangle> triangles;
  for (const PackedTriangle& p : get<PackedTriangle>(object, "triangles")) {
    Triangle t;
    t.vertices = p.vertices;
    t.alive = p.alive != 0;
    t.on_light = p.on_light != 0;
    t.normal = p.normal;
    t.area = p.area;
    t.emission = p.emission;
    t.shot = p.shot;
    triangles.push_back(t);
  }
  return {rules, bounds, std::move(vertices), std::move(triangles)};
}

json state_to_json(const GatheringState& state) {
  json object;
  std::vector<PackedLight> lights;
  std::vector<Link> links;
  std::vector<DividedCell> divided;
  for (const VertexLight& l : state.light) {
    lights.push_back({l.direct, l.indirect, l.direct_deviation, l.indirect_deviation, l.own_bend,
                      l.bend, l.escaped, l.excess, l.glimpse, l.glimpse_deviation, l.among,
                      l.beyond, l.depth, l.gathers, static_cast<std::uint32_t>(l.grid),
                      static_cast<std::uint32_t>(l.row.grid),
                      static_cast<std::uint32_t>(l.row.divided.size()), l.rays, l.row.rays.size()});
    links.insert(links.end(), l.row.rays.begin(), l.row.rays.end());
    divided.insert(divided.end(), l.row.divided.begin(), l.row.divided.end());
  }
  put(object, "light", lights);
  put(object, "links", links);
  put(object, "divided", divided);
  put(object, "sites", std::vector(state.sites.sites().begin(), state.sites.sites().end()));
  put(object, "surroundings", state.around);
  put(object, "sent", state.sent);
  std::vector<PackedMiddle> middles;
  for (const auto& [edge, light] : state.middles) middles.push_back({edge, light});
  put(object, "middles", middles);
  std::vector<PackedFinding> findings;
  for (const auto& [edge, finding] : state.indirect_findings) findings.push_back({edge, finding});
  put(object, "indirect_findings", findings);
  std::vector<PackedError> split_since;
  for (const auto& [edge, error] : state.split_since) split_since.push_back({edge, error});
  put(object, "split_since", split_since);
  for_each_scalar(state, [&](const char* key, double value) { object[key] = value; });
  object["tries"] = state.tries;
  object["statistics"] = statistics_to_json(state.statistics);
  return object;
}

/// A row has a ray for each cell and part of one.
void check(const Row<Link>& row) {
  if (row.grid < 0 || row.grid > HemisphereGather::kFinestGrid) damaged("light");
  std::size_t count = row.cells();
  for (const DividedCell& divided : row.divided) {
    if (divided.cell >= row.cells() || divided.parts == 0) damaged("divided");
    count += divided.count();
  }
  if (count != row.rays.size()) damaged("links");
}

GatheringState state_from_json(const json& object, Triangulation mesh, const Scene& scene) {
  GatheringState state(std::move(mesh));
  const std::size_t vertex_count = state.mesh.vertices().size();
  for (const Site& site : get<Site>(object, "sites")) {
    const std::uint32_t outside = HemisphereGather::outside_of(scene);
    const std::size_t count = site.surface == outside ? SkyDome::node_count() : vertex_count;
    const bool known = std::all_of(site.vertices.begin(), site.vertices.end(),
                                   [&](VertexId v) { return v < count; });
    if (!known || site.surface > outside) damaged("sites");
    state.sites.add(site);
  }
  const auto links = get<Link>(object, "links");
  for (const Link& link : links) {
    if (link.site >= state.sites.sites().size()) damaged("links");
  }
  const auto divided = get<DividedCell>(object, "divided");
  std::size_t next = 0, next_divided = 0;
  for (const PackedLight& p : get<PackedLight>(object, "light")) {
    state.light.push_back(
        {p.direct,
         p.indirect,
         p.direct_deviation,
         p.indirect_deviation,
         p.own_bend,
         p.bend,
         p.escaped,
         p.excess,
         p.glimpse,
         p.glimpse_deviation,
         p.among,
         p.depth,
         p.gathers != 0,
         static_cast<int>(p.grid),
         p.rays,
         p.beyond,
         {static_cast<int>(p.kept_grid), take(divided, next_divided, p.divided, "divided"),
          take(links, next, p.links, "links")}});
    check(state.light.back().row);
    if (p.grid > HemisphereGather::kFinestGrid || !is_finite(p.beyond)) damaged("light");
  }
  state.sent = get<Rgb>(object, "sent");
  if (state.light.size() != vertex_count) damaged("light");
  for (const VertexLight& l : state.light) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = l.among.vertices[k];
      if (v >= vertex_count || !std::isfinite(l.among.weights[k])) damaged("light");
      if (l.among.weights[k] != 0 && state.light[v].depth >= l.depth) damaged("light");
    }
  }
  if (state.sent.size() != vertex_count) damaged("sent");
  state.around = get<Surroundings>(object, "surroundings");
  if (state.around.size() > vertex_count) damaged("surroundings");
  for (const Surroundings& s : state.around) {
    const bool sound = s.irradiance >= 0 && s.distance >= 0;
    if (!sound || !std::isfinite(s.irradiance + s.distance)) damaged("surroundings");
  }
  for (std::size_t v = state.around.size(); v < vertex_count && !state.around.empty(); ++v) {
    if (state.light[v].among.vertices[0] >= v) damaged("light");
  }
  for (const PackedMiddle& p : get<PackedMiddle>(object, "middles")) {
    state.middles[p.edge] = p.light;
  }
  for (const PackedFinding& p : get<PackedFinding>(object, "indirect_findings")) {
    state.indirect_findings[p.edge] = p.finding;
  }
  for (const PackedError& p : get<PackedError>(object, "split_since")) {
    state.split_since[p.edge] = p.error;
  }
  for_each_scalar(state, [&](const char* key, double& value) {
    const json& j = member(object, key);
    if (!j.is_number()) damaged(key);
    value = j.get<double>();
  });
  if (!(std::abs(state.lean) <= 1)) damaged("lean");
  if (!(state.mean_importance >= 1) || !std::isfinite(state.mean_importance)) {
    damaged("mean_importance");
  }
  constexpr std::uint64_t kMost = 1 << 16;
  state.tries = static_cast<int>(integer_member(object, "tries", kMost));
  state.statistics = statistics_from_json(member(object, "statistics"));
  return state;
}

/// What a checkpoint must agree with.
json circumstances(const Scene& scene, const Options& options) {
  return {{"format", kFormat},
          {"version", kVersion},
          {"scene", scene.source},
          {"options", options_to_json(options)}};
}

GatheringState decode(const std::string& bytes, const Scene& scene, const Options& options,
                      const Rules& rules) {
  const json root = json::from_cbor(bytes, true, false);
  if (root.is_discarded() || !root.is_object() || root.value("format", "") != kFormat) {
    throw InputError("is no checkpoint of isolux, or is cut off");
  }
  const json now = circumstances(scene, options);
  for (const char* key : {"version", "scene", "options"}) {
    if (member(root, key) != now[key]) {
      throw InputError(fmt::format(
          "is of {}; solve anew without it",
          std::string(key) == "options" ? "other options" : fmt::format("another {}", key)));
    }
  }
  Triangulation mesh = mesh_from_json(member(root, "mesh"), rules, scene.bounds());
  return state_from_json(member(root, "state"), std::move(mesh), scene);
}

}  // namespace

void save_checkpoint(const Scene& scene, const Options& options, const GatheringState& state,
                     const std::filesystem::path& path) {
  json root = circumstances(scene, options);
  root["mesh"] = mesh_to_json(state.mesh);
  root["state"] = state_to_json(state);
  std::string bytes;
  json::to_cbor(root, bytes);
  write_file(path, bytes);
}

GatheringState load_checkpoint(const Scene& scene, const Options& options,
                               const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  try {
    return decode(bytes, scene, options, gathering_rules(scene));
  } catch (const InputError& error) {
    throw InputError({path.string()}, error.what());
  }
}

}  // namespace isolux
