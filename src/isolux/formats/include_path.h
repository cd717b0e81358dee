#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace isolux {

/// A file of a scene, as read.
struct SourceText {
  std::string file;  ///< its name in messages
  std::string text;
};

/// The files of a scene that are open, one including the next. A file may include those in the
/// folder of the main file and below it; links that lead out of there are refused.
class Includes {
 public:
  /// The folder that names are relative to.
  enum class Base { including_file, main_file };

  /// `main_file` need not exist: its text may come from elsewhere.
  explicit Includes(std::filesystem::path main_file, Base base = Base::including_file);

  /// Reads the file that the innermost open one calls `name`, and makes it the innermost. Throws
  /// InputError (without a place: the reader that called adds it) where the name is absolute, leads
  /// out of the folder, or is that of a file that is open already; where it can't be read; where
  /// more than 32 files are open, or more than 1000 files or 256 MiB were included in all.
  SourceText open(std::string_view name);
  /// Closes the innermost file.
  void close() { open_.pop_back(); }

 private:
  Base base_;
  std::filesystem::path root_;               ///< the main file's folder, without links
  std::vector<std::filesystem::path> open_;  ///< as named in messages, the main file first
  std::size_t files_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace isolux
