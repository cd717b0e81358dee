#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "commands.h"
#include "exit_code.h"
#include "isolux/core/error.h"
#include "isolux/core/version.h"
#include "output.h"

namespace {

void parse_and_run(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    isolux::print(program.help());
  } catch (const CLI::CallForVersion& version) {
    isolux::print(std::string(version.what()) + "\n");
  }
}

int run(int argc, char** argv) {
  CLI::App program("Illumination of scenes by adaptive progressive radiosity on true geometry.",
                   "isolux");
  program.set_version_flag("--version", std::string("isolux ") + isolux::kVersion);
  program.require_subcommand(1);
  isolux::add_solve(program);
  isolux::add_render(program);
  isolux::add_measure(program);
  isolux::add_info(program);
  isolux::add_check(program);
  isolux::add_convert(program);
  // Last, since subcommands take over the footer there is.
  program.footer(
      "Each has its own --help. Lengths are in m, angles in degrees.\n"
      "Exit code: 0 done, 1 the input or the usage is wrong, 2 a fault of isolux,\n"
      "3 solved, but short of the tolerance.");
  try {
    parse_and_run(program, argc, argv);
    return isolux::kDone;
  } catch (const CLI::RuntimeError& end) {
    return end.get_exit_code();
  } catch (const CLI::ParseError& error) {
    isolux::say(fmt::format("{} (see 'isolux --help')", error.what()));
  } catch (const isolux::InputError& error) {
    isolux::say(error.what());
  }
  return isolux::kUserError;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    isolux::say("internal error: out of memory");
  } catch (const std::exception& error) {
    isolux::say(fmt::format("internal error: {}", error.what()));
  } catch (...) {
    isolux::say("internal error: of unknown kind");
  }
  return isolux::kInternalError;
}
