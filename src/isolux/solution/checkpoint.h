#pragma once

#include <filesystem>

#include "isolux/radiosity/gathering_state.h"
#include "isolux/radiosity/options.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// Writes what gather_radiosity() told a CheckpointCallback: whole or not at all. The file is for
/// the same version of isolux to go on from, on a machine of the same kind. Throws InputError where
/// it can't be written.
void save_checkpoint(const Scene& scene, const Options& options, const GatheringState& state,
                     const std::filesystem::path& path);

/// Reads it back. Throws InputError, with the file's name, where the file is damaged, or is of
/// another version, scene or other options (bounds on triangles, tolerance, seed).
GatheringState load_checkpoint(const Scene& scene, const Options& options,
                               const std::filesystem::path& path);

}  // namespace isolux
