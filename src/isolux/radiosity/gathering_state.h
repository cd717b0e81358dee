#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/discretization/interpolation.h"
#include "isolux/radiosity/links.h"
#include "isolux/radiosity/progress.h"
#include "isolux/radiosity/row.h"
#include "isolux/radiosity/statistics.h"

namespace isolux {

/// The light of a vertex by its parts, E = E_d + E_i: straight from the lights, and by reflection.
struct VertexLight {
  Rgb direct, indirect;                                 // lx
  double direct_deviation = 0, indirect_deviation = 0;  // σ of their luminance, lx
  /// What interpolating E_i may have cost, lx: here, and with what its parents have of it.
  double own_bend = 0, bend = 0;
  double escaped = 0;  // part of the hemisphere from where no light can come back
  double excess = 0;   // by how much interpolation around it is too bright, lx
  double glimpse = 0, glimpse_deviation = 0;  // E_i's luminance by few rays, and its σ, lx
  MeshPlace among;          // the vertices that E_i is interpolated from if it does not
                            // gather: those it lies among, all of them less deep
  std::uint32_t depth = 0;  // 0: it has none, and gathers
  bool gathers = false;
  int grid = 0;            // of the rays it gathered with, cells a side
  std::uint32_t rays = 0;  // their number
  Rgb beyond;     // lx: what these brought more than those that are kept, under the light of then
  Row<Link> row;  // those that are kept; few where it does not gather, for a glimpse
};

/// E_d in the middle of an edge. In single precision, for there are many.
struct MiddleLight {
  std::array<float, 3> direct{};  // lx
  float deviation = 0;            // σ of its luminance, lx
  float error = 0;                // of interpolation there, lx, positive where it is too bright
};

/// What interpolating E_i in the middle of an edge was found to be off by, lx, positive where it is
/// too bright, and σ of what was found.
struct EdgeFinding {
  float error = 0;
  float deviation = 0;
};

/// What a vertex sees of other surfaces, on average over its hemisphere.
struct Surroundings {
  double irradiance = 0;  ///< of theirs, lx; 0 where none is seen
  double distance = 0;    ///< m
};

/// What gathering knows between two of its rounds: enough to go on from there.
struct GatheringState {
  explicit GatheringState(Triangulation triangulation) : mesh(std::move(triangulation)) {}

  /// Lets vertex v lie among others, if any weighs more than 0.
  void give_parents(VertexId v, const MeshPlace& among) {
    light[v].among = among;
    light[v].depth = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (among.weights[k] > 0) {
        light[v].depth = std::max(light[v].depth, light[among.vertices[k]].depth + 1);
      }
    }
  }

  Triangulation mesh;
  std::vector<VertexLight> light;    // by vertex
  SiteTable sites;                   // where the links in `light` lead
  std::vector<Surroundings> around;  // by vertex, of the older ones; empty where there is no sky
  std::vector<Rgb> sent;             // E by vertex as its triangles have it on average, lx
  /// What was found in the middle of edges, by the ends a < b: a × 2³² + b.
  std::unordered_map<std::uint64_t, MiddleLight> middles;
  std::unordered_map<std::uint64_t, EdgeFinding> indirect_findings;
  /// Edges that were split since links were last made or found good, and their |e|.
  std::unordered_map<std::uint64_t, float> split_since;
  double level = 0;  // the tolerance that is being worked for
  int tries = 0;     // levels below the tolerance asked for
  double direct_mean_square = 0, indirect_mean_square = 0;  // of interpolation, relative
  double mean_importance = 1;     // Gathering::room_importance(), over all surfaces
  double narrow_mean_square = 0;  // of interpolating E_d along edges too short to be split
  // The rules for errors of interpolating E_i are right times this: at vertices among others, and
  // between gathering ones.
  double bend_scale = 0.7, edge_scale = 0.7;
  // Of looked-at edges between gathering vertices: their errors, what the rule foresaw, m² lx, and
  // the one in parts of the other.
  double found = 0, foreseen = 0, lean = 0;
  double bias = 0;        // mean of MiddleLight::error, lx
  Rgb balance = gray(1);  // what is gathered is put right by, so that all light sent arrives
  Statistics statistics;
};

/// Told between two rounds; may keep a copy for gather_radiosity() to go on from.
using CheckpointCallback = std::function<void(const GatheringState&)>;

struct GatheringCallbacks {
  ProgressCallback progress;      ///< may end the solve
  CheckpointCallback checkpoint;  ///< told between two rounds
};

}  // namespace isolux
