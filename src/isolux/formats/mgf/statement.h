#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/core/error.h"
#include "isolux/formats/include_path.h"

namespace isolux::mgf {

/// One entity with its arguments: the words of a line, continued where the line ends in '\'. Word 0
/// is the keyword. It refers to the text that it was read from.
class Statement {
 public:
  struct Word {
    std::string_view text;
    int line;
    int column;
  };

  Statement(const std::string& file, std::vector<Word> words)
      : file_(&file), words_(std::move(words)) {}

  std::size_t size() const { return words_.size(); }
  std::string_view word(std::size_t i) const { return words_[i].text; }
  SourceLocation location(std::size_t i = 0) const {
    return {*file_, words_[i].line, words_[i].column};
  }
  [[noreturn]] void fail(std::size_t i, const std::string& message) const;

  static constexpr std::size_t kAnyNumber = std::size_t{1} << 60;
  /// Demands `least` to `most` words after the keyword; `usage` shows them in the message.
  void expect_arguments(std::size_t least, std::size_t most, std::string_view usage) const;

  double number(std::size_t i) const;                ///< finite
  double number_of_at_least_0(std::size_t i) const;  ///< finite
  int integer(std::size_t i, int least, int most) const;

 private:
  const std::string* file_;
  std::vector<Word> words_;
};

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

}  // namespace isolux::mgf
