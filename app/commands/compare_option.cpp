#include "app/commands/compare_option.h"

#include "app/command_line/command.h"
#include "app/command_line/usage_message.h"

namespace jnd::app {

analysis::BlockNames compared_names(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || comma == 0 || comma + 1 == text.size() ||
      text.find(',', comma + 1) != std::string::npos) {
    throw UsageError(
        "--compare: expected two names of blocks, such as group_d,group_e, found `" +
        one_line(text) + "`");
  }
  return {text.substr(0, comma), text.substr(comma + 1)};
}

void add_compare_option(CLI::App& command, std::vector<std::string>& given) {
  command
      .add_option("--compare", given,
                  "Blocks whose Weber fractions are compared, once for each two; default: "
                  "every two of a quantity, or of many each with the next, as exploratory. "
                  "Asking here plans nothing: the results say that they were asked for")
      ->type_name("FIRST,SECOND")
      ->allow_extra_args(false);
}

std::vector<analysis::BlockNames> compared_names(const std::vector<std::string>& given) {
  std::vector<analysis::BlockNames> names;
  for (const std::string& one : given) names.push_back(compared_names(one));
  return names;
}

}  // namespace jnd::app
