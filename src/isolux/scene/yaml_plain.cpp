#include "isolux/scene/yaml_plain.h"

#include <yaml-cpp/mark.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace isolux {
namespace {

constexpr std::size_t kLongestKey = 200;  ///< bytes; YAML ends at 1024

/// What characters may do in a plain word.
enum Role : unsigned char { kNowhere, kWithin, kAnywhere };

constexpr std::array<Role, 256> roles() {
  std::array<Role, 256> all{};
  for (int c = 0x80; c < 0x100; ++c) all[static_cast<std::size_t>(c)] = kWithin;
  for (const char c : std::string_view(" -()%=;<>$^*~@!&|'\"")) {
    all[static_cast<unsigned char>(c)] = kWithin;
  }
  for (const char c : std::string_view("0123456789_./+"
                                       "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ")) {
    all[static_cast<unsigned char>(c)] = kAnywhere;
  }
  return all;
}

constexpr std::array<Role, 256> kRoles = roles();

Role role(char c) { return kRoles[static_cast<unsigned char>(c)]; }

/// Thrown where the text is not plain.
struct NotPlain {};

class PlainParser {
 public:
  PlainParser(std::string_view text, YAML::EventHandler& handler)
      : text_(text), handler_(handler) {}

  void parse() {
    to_content();
    if (at_end() || column() != 0 || is_item()) throw NotPlain{};
    handler_.OnDocumentStart(mark());
    read_map(0);
    if (!at_end()) throw NotPlain{};
    handler_.OnDocumentEnd();
  }

 private:
  struct Word {
    YAML::Mark mark;
    std::string_view text;
    bool quoted;
  };

  bool at_end() const { return at_ == text_.size(); }
  char here() const { return at_end() ? '\n' : text_[at_]; }
  char ahead() const { return at_ + 1 < text_.size() ? text_[at_ + 1] : '\n'; }
  int column() const { return static_cast<int>(at_ - line_start_); }
  YAML::Mark mark() const {
    YAML::Mark mark;
    mark.pos = static_cast<int>(at_);
    mark.line = line_;
    mark.column = column();
    return mark;
  }
  bool is_item() const { return here() == '-' && (ahead() == ' ' || ahead() == '\n'); }

  void skip_spaces() {
    while (!at_end() && text_[at_] == ' ') ++at_;
  }

  /// Whether nothing but a comment is left in the line, whose end the place then is.
  bool ends_line() {
    const std::size_t before = at_;
    skip_spaces();
    if (here() == '#' && (at_ > before || column() == 0))
      at_ = std::min(text_.find('\n', at_), text_.size());
    return here() == '\n';
  }

  /// From the end of a line, or the start of the text, to what comes next after blank lines and
  /// comments.
  void to_content() {
    while (ends_line() && !at_end()) {
      ++at_;
      ++line_;
      line_start_ = at_;
    }
  }

  void end_line() {
    if (!ends_line()) throw NotPlain{};
    to_content();
  }

  Word quoted_word() {
    const char quote = here();
    Word word{mark(), {}, true};
    const std::size_t first = ++at_;
    while (here() != quote) {
      if (here() == '\n' || here() == '\t' || here() == '\\') throw NotPlain{};
      ++at_;
    }
    word.text = text_.substr(first, at_ - first);
    ++at_;
    if (here() == quote) throw NotPlain{};  // '' stands for '
    return word;
  }

  /// A word up to a colon, comma, bracket, comment or line's end.
  Word word() {
    if (here() == '"' || here() == '\'') return quoted_word();
    const bool negative = here() == '-' && role(ahead()) == kAnywhere;
    if (!negative && role(here()) != kAnywhere) throw NotPlain{};
    const Word start{mark(), {}, false};
    const std::size_t first = at_;
    std::size_t last = at_;  // behind the last character that is no space
    for (; !at_end() && role(text_[at_]) != kNowhere; ++at_) {
      if (text_[at_] != ' ') last = at_ + 1;
    }
    if (here() == '#' && at_ == last) throw NotPlain{};
    at_ = last;
    const std::string_view text = text_.substr(first, last - first);
    const bool has_meaning = text == "null" || text == "Null" || text == "NULL";
    if (has_meaning || text.starts_with("...")) throw NotPlain{};
    return {start.mark, text, false};
  }

  void give(const Word& word) {
    value_.assign(word.text);
    handler_.OnScalar(word.mark, word.quoted ? quoted_tag_ : plain_tag_, 0, value_);
  }

  void give_key() {
    const Word key = word();
    skip_spaces();
    if (here() != ':' || (ahead() != ' ' && ahead() != '\n') || key.text.size() > kLongestKey) {
      throw NotPlain{};
    }
    ++at_;
    give(key);
  }

  /// Whether a key and its colon stand here.
  bool is_key() {
    if (here() == '[' || here() == '{') return false;
    const std::size_t before = at_;
    word();
    skip_spaces();
    const bool found = here() == ':';
    at_ = before;
    return found;
  }

  /// A list or map in brackets, or a word among them.
  void read_flow() {
    const char opening = here();
    if (opening != '[' && opening != '{') return give(word());
    const bool map = opening == '{';
    const char closing = map ? '}' : ']';
    if (map) {
      handler_.OnMapStart(mark(), plain_tag_, 0, YAML::EmitterStyle::Flow);
    } else {
      handler_.OnSequenceStart(mark(), plain_tag_, 0, YAML::EmitterStyle::Flow);
    }
    ++at_;
    skip_spaces();
    while (here() != closing) {
      if (map) give_key();
      skip_spaces();
      read_flow();
      skip_spaces();
      if (here() == closing) break;
      if (here() != ',') throw NotPlain{};
      ++at_;
      skip_spaces();
      if (here() == closing) throw NotPlain{};
    }
    ++at_;
    map ? handler_.OnMapEnd() : handler_.OnSequenceEnd();
  }

  /// What stands behind a key or a dash at column `indent`, in this line or below. A list may begin
  /// right under its key.
  void read_value(int indent, bool behind_key) {
    if (ends_line()) {
      to_content();
      if (at_end()) throw NotPlain{};
      if (is_item() && (column() > indent || (behind_key && column() == indent))) {
        return read_list(column());
      }
      if (column() <= indent || !is_key()) throw NotPlain{};
      return read_map(column());
    }
    skip_spaces();
    if (is_item()) throw NotPlain{};
    if (!behind_key && is_key()) return read_map(column());
    if (here() == '[' || here() == '{') {
      read_flow();
    } else {
      give(word());
    }
    end_line();
    if (!at_end() && column() > indent) throw NotPlain{};  // a word of several lines
  }

  void read_list(int indent) {
    handler_.OnSequenceStart(mark(), plain_tag_, 0, YAML::EmitterStyle::Block);
    while (!at_end() && column() == indent && is_item()) {
      ++at_;
      read_value(indent, false);
    }
    if (!at_end() && column() > indent) throw NotPlain{};
    handler_.OnSequenceEnd();
  }

  void read_map(int indent) {
    handler_.OnMapStart(mark(), plain_tag_, 0, YAML::EmitterStyle::Block);
    while (!at_end() && column() == indent && !is_item()) {
      give_key();
      read_value(indent, true);
    }
    if (!at_end() && column() > indent) throw NotPlain{};
    handler_.OnMapEnd();
  }

  std::string_view text_;
  YAML::EventHandler& handler_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 0;
  std::string value_;
  const std::string plain_tag_ = "?", quoted_tag_ = "!";
};

}  // namespace

bool parse_plain(std::string_view text, YAML::EventHandler& handler) {
  if (text.find('\r') != text.npos) return false;
  try {
    PlainParser(text, handler).parse();
    return true;
  } catch (const NotPlain&) {
    return false;
  }
}

}  // namespace isolux
