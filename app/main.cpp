#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "app/command.h"
#include "app/commands/validate.h"
#include "core/error.h"

namespace {

bool asks_for_json(int argc, char** argv) {
  return std::any_of(argv, argv + argc,
                     [](const char* word) { return std::string_view(word) == "--json"; });
}

int failed(int code, const char* sentence) {
  std::fprintf(stderr, "jnd: %s\n", sentence);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace jnd;
  CLI::App program("jnd - a haptic psychophysics laboratory", "jnd");
  program.set_version_flag("--version", JND_VERSION);
  program.require_subcommand(0, 1);
  app::Invocation invocation;
  try {
    for (const app::Registration add : app::registrations()) add(program, invocation);
    program.parse(argc, argv);
    if (invocation.run) return invocation.run();
    return failed(
        app::kEnvironmentLacks,
        "no display was found for the window; `jnd --help` lists what works without one");
  } catch (const CLI::ParseError& error) {
    // CLI11 has codes of its own: asking for help is 0, everything else is wrong usage.
    return program.exit(error) == 0 ? app::kDone : app::kWrongUsage;
  } catch (const app::EnvironmentError& error) {
    return failed(app::kEnvironmentLacks, error.what());
  } catch (const app::UsageError& error) {
    return failed(app::kWrongUsage, error.what());
  } catch (const core::Error& error) {
    if (asks_for_json(argc, argv)) std::puts(app::error_json(error).c_str());
    return failed(app::kHasProblems, error.what());
  } catch (const std::exception& error) {
    return failed(app::kOwnFault, error.what());
  }
}
