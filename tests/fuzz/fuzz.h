#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "isolux/core/error.h"

namespace isolux {

/// A folder of this process's own, removed at its regular end.
inline const std::filesystem::path& fuzz_folder() {
  static const struct Folder {
    Folder() {
      std::string name = (std::filesystem::temp_directory_path() / "isolux-XXXXXX").string();
      if (!::mkdtemp(name.data())) std::abort();
      path = name;
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::filesystem::path path;
  } folder;
  return folder.path;
}

inline std::filesystem::path write_fuzz_file(const char* name, std::string_view bytes) {
  const auto path = fuzz_folder() / name;
  std::filesystem::remove(path);  // else some file systems write it to the disk at once
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

/// Calls `read`, whose one way to fail is an InputError of one line.
template <typename Read>
void expect_no_harm(Read read) {
  try {
    read();
  } catch (const InputError& error) {
    if (std::strchr(error.what(), '\n')) std::abort();
  }
}

}  // namespace isolux
