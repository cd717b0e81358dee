#include "isolux/core/error.h"

#include <fmt/format.h>

namespace isolux {
namespace {

std::string locate(const SourceLocation& where, const std::string& message) {
  if (where.file.empty()) return message;
  if (where.line <= 0) return fmt::format("{}: {}", where.file, message);
  return fmt::format("{}:{}:{}: {}", where.file, where.line, where.column, message);
}

}  // namespace

InputError::InputError(const SourceLocation& where, const std::string& message)
    : std::runtime_error(locate(where, message)) {}

}  // namespace isolux
