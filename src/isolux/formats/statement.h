#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/core/error.h"
#include "isolux/formats/include_path.h"

namespace isolux {

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

}  // namespace isolux
