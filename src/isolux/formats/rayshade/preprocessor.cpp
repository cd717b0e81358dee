#include "isolux/formats/rayshade/preprocessor.h"

#include <fmt/format.h>

#include <algorithm>

#include "isolux/core/file.h"
#include "isolux/formats/include_path.h"
#include "isolux/formats/rayshade/macros.h"
#include "isolux/scene/spelling.h"

namespace isolux::rayshade {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLargestText = std::size_t{64} << 20;  ///< bytes, of all files together

/// The characters of one file, and the place of the next.
class Cursor {
 public:
  Cursor(std::string_view text, const std::string& file) : text_(text) { place_.file = &file; }

  bool at_end() const { return at_ == text_.size(); }
  std::string_view rest() const { return text_.substr(at_); }
  bool next_is(std::string_view word) const { return rest().starts_with(word); }
  const Place& place() const { return place_; }
  char take() {
    const char c = text_[at_++];
    c == '\n' ? (++place_.line, place_.column = 1) : ++place_.column;
    return c;
  }
  /// Takes a comment.
  void skip_comment() {
    const Place start = place_;
    take(), take();
    while (!at_end() && !next_is("*/")) take();
    if (at_end()) fail(start, "this comment never ends: close it by '*/'");
    take(), take();
  }
  /// Takes the rest of the line, joined with those after it that a '\' at the end announces,
  /// comments turned to spaces.
  std::string take_line() {
    std::string line;
    while (!at_end()) {
      if (next_is("/*")) {
        skip_comment();
        line += ' ';
      } else if (next_is("\\\n") || next_is("\\\r\n")) {
        while (take() != '\n') {
        }
        line += ' ';
      } else if (const char c = take(); c == '\n') {
        break;
      } else if (c != '\r') {
        line += c;
      }
    }
    return line;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  Place place_;
};

class Preprocessor {
 public:
  explicit Preprocessor(const fs::path& scene) : includes_(scene, Includes::Base::main_file) {
    read_file({scene.string(), isolux::read_file(scene, kLargestText)});
  }
  SourceText take() { return std::move(source_); }

 private:
  /// A condition that is open.
  struct Condition {
    Place place;
    bool outer;             ///< whether what is around it counts
    bool holds;             ///< whether what comes now does, as far as it is concerned
    bool inverted = false;  ///< whether its #else has been
  };

  bool active() const {
    return conditions_.empty() || (conditions_.back().outer && conditions_.back().holds);
  }
  void read_file(const isolux::SourceText& file);
  void read_text(Cursor& in);
  void identifier(Cursor& in);
  void directive(Cursor& in);
  void include(std::string_view what, const Place& place);
  void condition(std::string_view word, std::string_view what, const Place& place);
  void copy(Cursor& in, std::size_t count);

  Includes includes_;
  SourceText source_;
  Macros macros_;
  std::vector<Condition> conditions_;
  bool joined_ = false;  ///< whether the next character continues the last piece
  std::size_t read_bytes_ = 0;
};

/// Takes blanks, and the identifier after them, off the front of the text.
std::string_view take_word(std::string_view& text) {
  const auto skip_blanks = [&] {
    while (!text.empty() && (text[0] == ' ' || text[0] == '\t')) text.remove_prefix(1);
  };
  skip_blanks();
  const std::string_view word = leading_identifier(text);
  text.remove_prefix(word.size());
  skip_blanks();
  return word;
}

void Preprocessor::read_file(const isolux::SourceText& file) {
  read_bytes_ += file.text.size();
  source_.files.push_back(file.file);
  Cursor in(file.text, source_.files.back());
  if (read_bytes_ > kLargestText) fail(in.place(), "the scene's files have more than 64 MiB");
  const std::size_t outer = conditions_.size();
  joined_ = false;
  read_text(in);
  joined_ = false;
  if (conditions_.size() > outer) {
    fail(conditions_.back().place, "this condition lacks its '#endif'");
  }
}

void Preprocessor::read_text(Cursor& in) {
  bool at_line_start = true;
  while (!in.at_end()) {
    const std::string_view rest = in.rest();
    if (at_line_start) {
      const std::size_t first = rest.find_first_not_of(" \t");
      if (first != rest.npos && rest[first] == '#') {
        while (in.take() != '#') {
        }
        directive(in);
        continue;
      }
    }
    at_line_start = rest[0] == '\n';
    if (in.next_is("/*")) {
      in.skip_comment();
      source_.text += ' ';
      joined_ = false;
    } else if (!active()) {
      in.take();
      joined_ = false;
    } else if (starts_identifier(rest[0])) {
      identifier(in);
    } else {
      copy(in, std::max<std::size_t>(1, leading_number(rest).size()));
    }
  }
}

void Preprocessor::copy(Cursor& in, std::size_t count) {
  if (!joined_) source_.pieces.push_back({source_.text.size(), in.place(), true});
  joined_ = true;
  for (; count > 0; --count) source_.text += in.take();
}

void Preprocessor::identifier(Cursor& in) {
  const std::string name(leading_identifier(in.rest()));
  const std::size_t after = in.rest().find_first_not_of(" \t\r\n", name.size());
  const bool called = after != in.rest().npos && in.rest()[after] == '(';
  if (!macros_.is_defined(name) || (macros_.takes_arguments(name) && !called)) {
    copy(in, name.size());
    return;
  }
  const Place place = in.place();
  std::string call;
  for (std::size_t i = 0; i < name.size(); ++i) call += in.take();
  if (macros_.takes_arguments(name)) {
    int depth = 0;
    do {
      if (in.at_end()) {
        fail(place, fmt::format("the call of macro {} lacks its ')'", in_quotes(name)));
      }
      if (in.next_is("/*")) {
        in.skip_comment();
        continue;
      }
      const char c = in.take();
      depth += c == '(' ? 1 : c == ')' ? -1 : 0;
      call += c;
    } while (depth > 0 || call.back() != ')');
  }
  source_.pieces.push_back({source_.text.size(), place, false});
  source_.text += macros_.expand(call, place);
  joined_ = false;
}

void Preprocessor::directive(Cursor& in) {
  const Place place = in.place();
  const std::string line = in.take_line();
  source_.text += '\n';
  joined_ = false;
  std::string_view rest = line;
  const std::string_view word = take_word(rest);
  const bool marks_line = word.empty() || word == "line";  // '# 12 "file"', or nothing at all
  if (marks_line) return;
  if (word == "ifdef" || word == "ifndef" || word == "if" || word == "else" || word == "endif") {
    condition(word, rest, place);
  } else if (!active()) {
    return;
  } else if (word == "define") {
    macros_.define(rest, place);
  } else if (word == "undef") {
    macros_.undefine(take_word(rest));
  } else if (word == "include") {
    include(rest, place);
  } else {
    fail(place, fmt::format("unknown directive {}: {}", in_quotes(word),
                            suggestion(word, {"define", "undef", "include", "ifdef", "ifndef", "if",
                                              "else", "endif"})));
  }
}

void Preprocessor::condition(std::string_view word, std::string_view what, const Place& place) {
  if (word == "else" || word == "endif") {
    if (conditions_.empty() || conditions_.back().place.file != place.file) {
      fail(place, fmt::format("'#{}' without a condition before it", word));
    }
    if (word == "endif") {
      conditions_.pop_back();
      return;
    }
    Condition& last = conditions_.back();
    if (last.inverted) fail(place, "a second '#else' of one condition");
    last.inverted = true;
    last.holds = !last.holds;
    return;
  }
  bool holds = false;
  if (word == "if") {
    const std::string value = active() ? macros_.expand(what, place) : "0";
    const std::size_t digits = value.find_first_not_of(" \t");
    if (digits == value.npos || value.find_first_not_of("0123456789 \t") != value.npos) {
      fail(place, "'#if' is read with a plain number only, such as '#if 0': use '#ifdef'");
    }
    holds = value.find_first_of("123456789") != value.npos;
  } else {
    const std::string_view name = take_word(what);
    if (name.empty()) fail(place, fmt::format("'#{}' needs a name", word));
    holds = macros_.is_defined(name) == (word == "ifdef");
  }
  conditions_.push_back({place, active(), holds});
}

void Preprocessor::include(std::string_view what, const Place& place) {
  const char close = !what.empty() && what[0] == '<' ? '>' : '"';
  const std::size_t end = what.size() > 1 ? what.find(close, 1) : what.npos;
  if ((what.empty() || (what[0] != '"' && what[0] != '<')) || end == what.npos) {
    fail(place, "'#include' needs the name of a file in quotes, such as \"glass.def.ray\"");
  }
  isolux::SourceText file;
  try {
    file = includes_.open(what.substr(1, end - 1));
  } catch (const InputError& error) {
    fail(place, error.what());
  }
  read_file(file);
  includes_.close();
}

}  // namespace

SourceText preprocess(const fs::path& scene) { return Preprocessor(scene).take(); }

}  // namespace isolux::rayshade
