#include "isolux/formats/include_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostOpen = 32;
constexpr std::size_t kMostFiles = 1000;
constexpr std::size_t kMostBytes = std::size_t{256} << 20;

/// The path without links and dots, as far as it exists.
fs::path resolved(const fs::path& path) {
  std::error_code failure;
  fs::path result = fs::weakly_canonical(fs::absolute(path, failure), failure);
  return failure ? path.lexically_normal() : result;
}

bool is_below(const fs::path& folder, const fs::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

}  // namespace

Includes::Includes(fs::path main_file, Base base) : base_(base) {
  root_ = resolved(main_file.has_parent_path() ? main_file.parent_path() : fs::path("."));
  open_.push_back(std::move(main_file));
}

SourceText Includes::open(std::string_view name) {
  const fs::path given(name);
  if (given.empty() || given.is_absolute()) {
    throw InputError(fmt::format("{} can't be included: give a path relative to {}",
                                 in_quotes(name),
                                 base_ == Base::main_file ? "the scene's folder" : "this file"));
  }
  const fs::path& from = base_ == Base::main_file ? open_.front() : open_.back();
  const fs::path path = (from.parent_path() / given).lexically_normal();
  const fs::path target = resolved(path);
  if (!is_below(root_, target)) {
    throw InputError(
        fmt::format("{} lies outside the folder of the scene: move it there", in_quotes(name)));
  }
  for (const fs::path& outer : open_) {
    if (resolved(outer) == target) {
      throw InputError(fmt::format("{} includes itself", in_quotes(name)));
    }
  }
  if (open_.size() > kMostOpen) {
    throw InputError(fmt::format("files include one another more than {} deep", kMostOpen));
  }
  if (++files_ > kMostFiles) {
    throw InputError(fmt::format("more than {} files are included", kMostFiles));
  }
  std::error_code failure;
  if (!fs::is_regular_file(target, failure)) {
    throw InputError(fmt::format("there is no file {}", in_quotes(name)));
  }
  SourceText source{path.string(), read_file(target, kMostBytes - bytes_)};
  bytes_ += source.text.size();
  open_.push_back(path);
  return source;
}

}  // namespace isolux
