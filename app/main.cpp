#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>

#include "app/command_line/command.h"
#include "app/command_line/open_window.h"
#include "app/command_line/usage_message.h"
#include "app/commands/validate.h"
#include "core/missing_right.h"
#include "device/haptic_device.h"

namespace {

bool asks_for_json(int argc, char** argv) {
  return std::any_of(argv, argv + argc,
                     [](const char* word) { return std::string_view(word) == "--json"; });
}

int failed(int code, const char* sentence) {
  std::fprintf(stderr, "jnd: %s\n", sentence);
  return code;
}

/// True if the reader of our output has closed it, as `head` does when it has seen enough.
bool reader_is_gone() {
  pollfd out{.fd = STDOUT_FILENO, .events = 0, .revents = 0};
  return ::poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

/// A result that could not be printed counts as an error, unless nobody wants it any more.
int printed(int code) {
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (written || code != jnd::app::kDone || reader_is_gone()) return code;
  return failed(
      jnd::app::kEnvironmentLacks,
      "stdout: expected to be written in full, found that it was not; make room where "
      "it leads to and run it again");
}

int invoke(int argc, char** argv) {
  using namespace jnd;
  CLI::App program("jnd - a haptic psychophysics laboratory", "jnd");
  program.set_version_flag("--version", JND_VERSION);
  program.require_subcommand(0, 1);
  app::Invocation invocation;
  invocation.examples[&program] = {
      {"jnd", "opens the window"},
      {"jnd demo --fast", "runs both studies of the thesis in a few seconds"},
      {"jnd doctor", "tells what this machine lacks"}};
  try {
    for (const app::Registration add : app::registrations()) add(program, invocation);
    program.parse(argc, argv);
    app::refuse_options_as_values(program);
    if (invocation.run) return invocation.run();
    return app::open_window({});
  } catch (const CLI::ParseError& error) {
    // CLI11 has exit codes of its own: asking for help is 0, and everything else is wrong
    // usage.
    if (error.get_exit_code() == 0) return program.exit(error);
    return failed(app::kWrongUsage, app::usage_message(program, error).c_str());
  } catch (const app::EnvironmentError& error) {
    return failed(app::kEnvironmentLacks, error.what());
  } catch (const app::UsageError& error) {
    return failed(app::kWrongUsage, error.what());
  } catch (const device::DeviceUnreachable& error) {
    return failed(app::kEnvironmentLacks, error.what());
  } catch (const core::MissingRight& error) {
    return failed(app::kEnvironmentLacks, error.what());
  } catch (const core::Error& error) {
    if (asks_for_json(argc, argv)) std::puts(app::error_json(error).c_str());
    return failed(app::kHasProblems, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    const core::Error told(
        error.path1().string().substr(0, 200) +
        ": expected a path that the system takes, found: " + error.code().message());
    if (asks_for_json(argc, argv)) std::puts(app::error_json(told).c_str());
    return failed(app::kHasProblems, told.what());
  } catch (const std::exception& error) {
    // `printed` tells about it.
    if (std::ferror(stdout) != 0) return app::kDone;
    return failed(app::kOwnFault, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  // If a reader of our output disappears, the session must not end.
  std::signal(SIGPIPE, SIG_IGN);
  // Everything that the program writes, including exports and reports, contains personal data,
  // so only its owner may read it.
  ::umask(S_IRWXG | S_IRWXO);
  return printed(invoke(argc, argv));
}
