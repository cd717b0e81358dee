#include "isolux/core/file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "isolux/core/error.h"

namespace isolux {
namespace fs = std::filesystem;

std::string read_file(const fs::path& path, std::size_t max_bytes) {
  const SourceLocation where{path.string()};
  std::error_code failure;
  if (fs::is_directory(path, failure)) throw InputError(where, "is a folder, not a file");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(where, fmt::format("can't be read: {}", std::strerror(errno)));
  std::string bytes;
  std::string block(std::size_t{1} << 16, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    bytes.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > max_bytes) {
      throw InputError(where, fmt::format("is larger than {} bytes", max_bytes));
    }
  }
  if (in.bad()) throw InputError(where, "can't be read to its end");
  return bytes;
}

void write_file(const fs::path& path, std::span<const char> bytes) {
  const SourceLocation where{path.string()};
  std::error_code failure;
  if (fs::is_directory(path, failure)) throw InputError(where, "is a folder, not a file");
  fs::path temporary = path;
  temporary += fmt::format(".part-{}", ::getpid());
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
      const std::string reason = std::strerror(errno);
      fs::remove(temporary, failure);
      throw InputError(where, fmt::format("can't be written: {}", reason));
    }
  }
  fs::rename(temporary, path, failure);
  if (failure) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw InputError(where, fmt::format("can't be written: {}", failure.message()));
  }
}

}  // namespace isolux
