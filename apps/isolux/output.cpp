#include "output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "isolux/core/error.h"

namespace isolux {
namespace fs = std::filesystem;

void check_output(const fs::path& path, std::initializer_list<const char*> extensions) {
  const SourceLocation where{path.string()};
  if (std::find(extensions.begin(), extensions.end(), path.extension()) == extensions.end()) {
    throw InputError(
        where, fmt::format("the output's name must end in {}", fmt::join(extensions, " or ")));
  }
  std::error_code failure;
  if (fs::exists(path, failure) && !fs::is_regular_file(path, failure)) {
    throw InputError(where, "is there already and is not a file: choose another name");
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, failure)) {
    throw InputError(where, fmt::format("there is no folder '{}': create it", folder.string()));
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw InputError(where, fmt::format("can't be written in folder '{}': {}", folder.string(),
                                        std::strerror(errno)));
  }
}

void check_distinct(const fs::path& input, const fs::path& output) {
  std::error_code failure;
  if (fs::equivalent(input, output, failure)) {
    throw InputError({output.string()}, "is the input too: choose another output");
  }
}

void print(std::string_view text) {
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!whole || std::fflush(stdout) != 0) {
    throw InputError({"standard output"},
                     fmt::format("can't be written: {}", std::strerror(errno)));
  }
}

void say(std::string message) {
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  fmt::print(stderr, "isolux: {}\n", message);
}

std::string describe(const SkyReport& sky) {
  return fmt::format("{:.6g} lx on an open horizontal surface, ground {:.6g} cd/m²",
                     sky.illuminance, sky.ground);
}

}  // namespace isolux
