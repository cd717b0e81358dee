#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "isolux/formats/include_path.h"
#include "isolux/formats/statement.h"

namespace isolux::radiance {

/// A primitive: its modifier, type and name, and its arguments, those of an alias being the name
/// that it stands for. It refers to the text that it was read from.
struct Primitive {
  Statement head;     ///< modifier, type, name
  Statement strings;  ///< their number, then the words
  Statement numbers;  ///< their number, then the words

  std::string_view modifier() const { return head.word(0); }
  std::string_view type() const { return head.word(1); }
  std::string_view name() const { return head.word(2); }
  /// Finite; i counts from 0.
  double number(std::size_t i) const { return numbers.number(i + 1); }
  std::size_t number_count() const { return numbers.size() - 1; }
  /// Demands that many numbers; `usage` names them in the message.
  void expect_numbers(std::size_t least, std::size_t most, std::string_view usage) const;
};

/// A line that begins with '!': programs, each with its arguments, the first one's output being the
/// input of the next.
struct Command {
  std::vector<Statement> stages;
  bool plain = true;  ///< no more of a shell's language than quotes and pipes
};

/// Cuts a text into primitives and commands; lines end in LF, CR or both. Throws InputError with
/// the place where that can't be done.
class Scanner {
 public:
  explicit Scanner(const SourceText& source);
  /// Reads the part of the text that the word is.
  Scanner(const SourceText& source, const Statement::Word& part);

  std::optional<std::variant<Primitive, Command>> next();
  /// The next word, a text in quotes being one; nothing at the end. '#' begins a comment.
  std::optional<Statement::Word> word();
  /// The words of the rest of the line, without comments, '\' at its end announcing that it goes
  /// on. Nothing where the text has ended.
  std::optional<Statement> line();

 private:
  bool at_end() const { return at_ >= text_.size(); }
  bool at_line_end() const { return text_[at_] == '\n' || text_[at_] == '\r'; }
  void step();
  void pass_blanks_and_comments();
  /// Passes blanks, and line ends behind a '\'.
  void pass_blanks_in_line();
  Statement::Word quoted();
  Statement::Word bare(std::string_view ends);
  Statement::Word checked(const Statement::Word& word) const;
  void add_to(std::vector<Statement::Word>& words, const Statement::Word& word) const;
  Command command();
  Primitive primitive();
  Statement::Word required_word(const Statement::Word& after, std::string_view what);
  Statement arguments(const Statement::Word& name, std::string_view what);

  const SourceText& source_;
  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, column_ = 1;
};

}  // namespace isolux::radiance
