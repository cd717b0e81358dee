#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include "isolux/scene/check.h"

namespace isolux {

/// Checks before the work that its result can be written: the extension is one of `extensions`,
/// the folder exists and may be written to, and no folder has that name. Throws InputError.
void check_output(const std::filesystem::path& path, std::initializer_list<const char*> extensions);

/// Throws InputError where the two name one file.
void check_distinct(const std::filesystem::path& input, const std::filesystem::path& output);

/// Writes to stdout. Throws InputError where it can't be written whole.
void print(std::string_view text);

/// Writes `isolux: message` and a line's end to stderr. Characters that would break the line or
/// steer the terminal become '?'.
void say(std::string message);

/// What reports say of a sky.
std::string describe(const SkyReport& sky);

}  // namespace isolux
