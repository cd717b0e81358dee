#include <fmt/format.h>

#include "isolux/formats/limits.h"
#include "isolux/formats/radiance/expression.h"
#include "isolux/formats/radiance/generators.h"
#include "isolux/formats/radiance/gensky.h"
#include "isolux/formats/radiance/reader.h"
#include "isolux/formats/transform.h"
#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace {

struct Generator {
  std::string_view program;
  std::vector<Surface> (*generate)(const Statement& s, Surroundings& around);
};

constexpr Generator kGenerators[] = {
    {"genbox", generate_box},        {"genprism", generate_prism}, {"genblinds", generate_blinds},
    {"genrev", generate_revolution}, {"genworm", generate_worm},   {"gensurf", generate_surface},
};

const Generator* generator_named(std::string_view program) {
  for (const Generator& generator : kGenerators) {
    if (generator.program == program) return &generator;
  }
  return nullptr;
}

/// Whether the program is carried out here.
bool is_known(std::string_view program) {
  return program == "xform" || program == "cat" || program == "gensky" ||
         generator_named(program) != nullptr;
}

}  // namespace

void Reader::run(const Command& command, const Context& context) {
  const auto skip = [&](std::size_t stage, std::string_view reason) {
    const std::string name = clean_name(command.stages[stage].word(0));
    notes_.add(fmt::format("command {} left out: {}", in_quotes(name), reason));
  };
  if (!command.plain) return skip(0, "it is written for a shell");
  std::optional<Context> inner;
  for (std::size_t i = command.stages.size(); i-- > 1;) {
    const Statement& stage = command.stages[i];
    const bool reads = stage.word(0) == "xform";
    if (!reads && is_known(stage.word(0))) return skip(i, "it takes what another program writes");
    if (!reads) return skip(i, "that program is not known");
    std::size_t at = 1;
    try {
      inner = transformed(stage, at, inner ? *inner : context);
    } catch (const Unsupported& reason) {
      return skip(i, reason.what + " is not known");
    }
    if (at < stage.size()) stage.fail(at, "here xform reads the output of the program before it");
  }
  const Statement& first = command.stages.front();
  if (first.word(0) == "gendaylit") {
    return skip(0, "that program is not known, but what it writes is: put that in its place");
  }
  if (!is_known(first.word(0))) return skip(0, "that program is not known");
  try {
    run(first, inner ? *inner : context);
  } catch (const Unsupported& reason) {
    skip(0, reason.what + " is not known");
  }
}

void Reader::run(const Statement& program, const Context& context) {
  const Generator* const generator = generator_named(program.word(0));
  if (program.word(0) == "gensky") {
    const SourceText sky{"gensky", generate_sky(program, notes_)};
    try {
      read(Scanner(sky), context);
    } catch (const InputError& error) {
      program.fail(0, error.what());
    }
    return;
  }
  if (!generator) {
    std::size_t at = 1;
    std::optional<Context> inner;
    if (program.word(0) == "xform") inner = transformed(program, at, context);
    if (at == program.size()) program.fail(0, "here this program needs the name of a file");
    for (; at < program.size(); ++at) read_file(program, at, inner ? *inner : context);
    return;
  }
  try {
    const std::vector<Surface> surfaces = generator->generate(program, around_);
    const Finish& finish = materials_.finish_of(
        context.modifier ? std::string_view(*context.modifier) : program.word(1));
    for (const Surface& surface : surfaces) {
      add_surface(surface, program.word(2), finish, context);
    }
  } catch (const InputError& error) {
    if (std::string_view(error.what()).starts_with(program.location().file + ':')) throw;
    program.fail(0, error.what());
  }
}

Context Reader::transformed(const Statement& s, std::size_t& at, const Context& outer) {
  Context inner;
  inner.turned_over = outer.turned_over;
  inner.prefix = outer.prefix;
  const auto argument = [&] {
    if (at + 1 == s.size()) s.fail(at, fmt::format("{} needs a name", in_quotes(s.word(at))));
    return std::string(s.word(++at));
  };
  std::optional<std::string> modifier;
  for (; at < s.size(); ++at) {
    const std::string_view option = s.word(at);
    if (option == "-n") {
      inner.prefix = inner.prefixed(argument()) + '.';
    } else if (option == "-m") {
      const std::string name = argument();
      if (!modifier) modifier = name;
    } else if (option == "-I") {
      inner.turned_over = !inner.turned_over;
    } else if (option == "-f") {
      throw Unsupported{"the option '-f'"};
    } else if (option != "-e" && option != "-c") {  // when commands are done, not what they do
      break;
    }
  }
  inner.modifier = outer.modifier ? outer.modifier : modifier;
  inner.maps = placed(s, at, outer.maps);
  return inner;
}

std::vector<Affine> Reader::placed(const Statement& s, std::size_t& at,
                                   const std::vector<Affine>& outer) {
  const std::size_t first = at;
  const std::vector<Affine> inner = read_transform(s, at, kMostMaps / outer.size());
  maps_made_ += outer.size() * inner.size();
  if (maps_made_ > kMostMaps) {
    s.fail(std::min(first, s.size() - 1),
           "the arrays of this scene have too many instances; use fewer");
  }
  std::vector<Affine> maps;
  maps.reserve(outer.size() * inner.size());
  for (const Affine& map : outer) {
    for (const Affine& local : inner) maps.push_back(map * local);
  }
  return maps;
}

}  // namespace isolux::radiance
