#pragma once

#include <CLI/CLI.hpp>

namespace isolux {

// One function for each subcommand, in a file of its own: adds it to the program. Parsing the
// command line then runs it. What the user got wrong leaves as InputError or CLI::ParseError.

void add_solve(CLI::App& program);
void add_render(CLI::App& program);
void add_measure(CLI::App& program);
void add_info(CLI::App& program);
void add_check(CLI::App& program);
void add_convert(CLI::App& program);

}  // namespace isolux
