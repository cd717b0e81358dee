#pragma once

#include "isolux/formats/include_path.h"
#include "isolux/formats/statement.h"

namespace isolux {

/// Cuts a text into statements; lines end in LF, CR or both. Blank lines and comments are left out,
/// and so is the mark that some editors put before UTF-8.
class StatementReader {
 public:
  explicit StatementReader(const SourceText& source)
      : source_(source), at_(source.text.starts_with("\xef\xbb\xbf") ? 3 : 0), line_start_(at_) {}

  std::optional<Statement> next();

 private:
  bool at_end() const { return at_ >= source_.text.size(); }
  bool at_line_end() const { return source_.text[at_] == '\n' || source_.text[at_] == '\r'; }
  void pass_line_end();
  /// Passes blanks, and line ends behind a '\'.
  void pass_blanks();

  const SourceText& source_;
  std::size_t at_;
  std::size_t line_start_;
  int line_ = 1;
};

}  // namespace isolux
