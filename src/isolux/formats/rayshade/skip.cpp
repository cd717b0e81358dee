// What is read only to be left out: options of Rayshade's own picture, textures, the air.
#include <fmt/format.h>

#include <algorithm>

#include "isolux/formats/rayshade/parser.h"
#include "isolux/scene/spelling.h"

namespace isolux::rayshade {
namespace {

constexpr std::string_view kPicture = "for Rayshade's own picture only";
constexpr std::string_view kPinhole = "cameras are pinholes";
constexpr std::string_view kStill = "the scene stands still, as it is at its start";
constexpr std::string_view kBlack = "what no surface covers is black";
constexpr std::string_view kClear = "the air is clear";
constexpr std::string_view kPlain = "surfaces are of one color, with 'diffuse' as reflectance";

/// A word with so many numbers behind it, and why it is left out.
struct Option {
  std::string_view word;
  int numbers;
  std::string_view reason;
};

constexpr Option kOptions[] = {
    {"aperture", 1, kPinhole},  {"focaldist", 1, kPinhole}, {"eyesep", 1, kPicture},
    {"window", 4, kPicture},    {"crop", 4, kPicture},      {"maxdepth", 1, kPicture},
    {"cutoff", 1, kPicture},    {"contrast", 3, kPicture},  {"shadowtransp", 0, kPicture},
    {"sample", 1, kPicture},    {"samples", 1, kPicture},   {"jittered", 0, kPicture},
    {"filter", 0, kPicture},    {"report", 0, kPicture},    {"outfile", 0, kPicture},
    {"print", 1, kPicture},     {"background", 3, kBlack},  {"frames", 1, kStill},
    {"framelength", 1, kStill}, {"shutter", 1, kStill},     {"starttime", 0, kStill},
    {"atmosphere", 0, kClear},
};

/// A kind of texture: numbers behind its word, or what stands there besides.
struct TextureKind {
  std::string_view word;
  int numbers;
  bool surface_first = false, file_first = false, file_last = false;
};

constexpr TextureKind kTextures[] = {
    {"checker", 0, true},
    {"blotch", 1},
    {"bump", 1},
    {"marble", 0, false, false, true},
    {"fbm", 6, false, false, true},
    {"fbmbump", 5},
    {"wood", 0},
    {"gloss", 1},
    {"cloud", 7},
    {"sky", 6},
    {"image", 0, false, true},
    {"stripe", 2, true},
    {"windy", 8},
    {"mount", 2, false, true},
};

}  // namespace

std::vector<std::string_view> Parser::option_words() {
  std::vector<std::string_view> words;
  for (const Option& option : kOptions) words.push_back(option.word);
  return words;
}

bool Parser::skip_option() {
  const auto option =
      std::find_if(std::begin(kOptions), std::end(kOptions),
                   [&](const Option& known) { return tokens_.next_is(known.word); });
  if (option == std::end(kOptions)) return false;
  tokens_.take();
  notes_.left_out(option->word, option->reason);
  tokens_.skip_numbers(option->numbers);
  if (option->word == "cutoff") {
    if (tokens_.number_follows()) tokens_.skip_numbers(2);
  } else if (option->word == "sample") {
    if (!tokens_.accept("jitter")) tokens_.accept("nojitter");
  } else if (option->word == "filter") {
    if (!tokens_.accept("box") && !tokens_.accept("gauss")) {
      fail(tokens_.peek().place, "'filter' needs 'box' or 'gauss'");
    }
    if (tokens_.number_follows()) tokens_.number();
  } else if (option->word == "report") {
    tokens_.accept("verbose");
    tokens_.accept("quiet");
    if (tokens_.number_follows()) tokens_.number();
    if (tokens_.name_follows()) tokens_.filename();
  } else if (option->word == "outfile") {
    tokens_.filename();
  } else if (option->word == "starttime") {
    tokens_.set_time(tokens_.number());
  } else if (option->word == "atmosphere") {
    skip_atmosphere();
  }
  return true;
}

void Parser::skip_atmosphere() {
  if (tokens_.number_follows()) tokens_.number();
  for (;;) {
    if (tokens_.accept("mist")) {
      tokens_.skip_numbers(8);
    } else if (tokens_.accept("fog")) {
      tokens_.skip_numbers(6);
    } else if (tokens_.accept("fogdeck")) {
      tokens_.skip_numbers(13);
    } else {
      return;
    }
  }
}

void Parser::skip_textures() {
  while (tokens_.accept("texture")) {
    notes_.left_out("texture", kPlain);
    skip_texture();
    transforms();
  }
}

void Parser::skip_texture() {
  const Token token = tokens_.take();
  const auto kind = std::find_if(std::begin(kTextures), std::end(kTextures),
                                 [&](const TextureKind& known) { return token.is(known.word); });
  if (kind == std::end(kTextures)) {
    std::vector<std::string_view> known;
    for (const TextureKind& other : kTextures) known.push_back(other.word);
    fail(token.place, fmt::format("unknown texture {}: {}", in_quotes(token.text),
                                  suggestion(token.text, known)));
  }
  if (kind->surface_first) surface();
  if (kind->file_first) tokens_.filename();
  tokens_.skip_numbers(kind->numbers);
  if (kind->word == "blotch") surface();
  if (kind->file_last && tokens_.name_follows()) tokens_.filename();
  if (kind->word == "stripe" && tokens_.next_is("map")) skip_mapping();
  while (kind->word == "image") {
    if (tokens_.accept("component")) {
      tokens_.take();
    } else if (tokens_.accept("tile") || tokens_.accept("range")) {
      tokens_.skip_numbers(2);
    } else if (tokens_.accept("textsurf")) {
      surface();
    } else if (tokens_.next_is("map")) {
      skip_mapping();
    } else if (!tokens_.accept("smooth")) {
      return;
    }
  }
}

void Parser::skip_mapping() {
  tokens_.take();
  const Token how = tokens_.take();
  if (!how.is("uv") && !how.is("spherical") && !how.is("cylindrical") && !how.is("planar")) {
    fail(how.place,
         fmt::format("unknown mapping {}: {}", in_quotes(how.text),
                     suggestion(how.text, {"uv", "spherical", "cylindrical", "planar"})));
  }
  if (!how.is("uv") && tokens_.number_follows()) tokens_.skip_numbers(9);
}

}  // namespace isolux::rayshade
