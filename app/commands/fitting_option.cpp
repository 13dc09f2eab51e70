#include "app/commands/fitting_option.h"

#include <CLI/CLI.hpp>

#include "app/command_line/command.h"
#include "app/command_line/usage_message.h"
#include "experiments/protocol/structure_check.h"

namespace jnd::app {

void add_fitting_option(CLI::App& command, std::vector<std::string>& given) {
  command
      .add_option("--fitting", given,
                  "How the device was fitted to the participant, as glove=M or thumb=\"thin "
                  "pad\"; kept with the points that are held and where they rest")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

std::map<std::string, std::string> fitting_given(const std::vector<std::string>& given) {
  constexpr std::size_t kLongest = 200;
  std::map<std::string, std::string> fitting;
  for (const std::string& one : given) {
    const std::size_t divider = one.find('=');
    const std::string key = one.substr(0, divider);
    const std::string value =
        divider == std::string::npos ? "" : one_line(one.substr(divider + 1));
    if (!experiments::is_name(key) || value.empty() || value.size() > kLongest) {
      throw UsageError(
          "--fitting: expected KEY=VALUE, the key of lower-case letters, digits and _, the "
          "value of at most 200 letters, found `" +
          one_line(one.substr(0, 80)) + "`");
    }
    if (!fitting.emplace(key, value).second) {
      throw UsageError("--fitting: expected each key once, found `" + key + "` a second time");
    }
  }
  return fitting;
}

}  // namespace jnd::app
