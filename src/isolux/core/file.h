#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace isolux {

/// The whole file as bytes. Throws InputError where it can't be read, is a folder, or is larger
/// than `max_bytes`.
std::string read_file(const std::filesystem::path& path,
                      std::size_t max_bytes = std::size_t{4} << 30);

/// Writes the file whole or not at all: into a temporary file beside it, then renamed over it.
/// Throws InputError where that fails; the old file, if any, is then as it was.
void write_file(const std::filesystem::path& path, std::span<const char> bytes);

}  // namespace isolux
