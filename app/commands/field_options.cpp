#include "app/commands/field_options.h"

#include "app/command_line/command.h"
#include "app/command_line/usage_message.h"

namespace jnd::app {

void add_field_option(CLI::App& command, std::vector<std::string>& given,
                      const std::string& help) {
  command.add_option("--field", given, help)->type_name("NAME=VALUE")->allow_extra_args(false);
}

experiments::FieldValues fields_given(const experiments::Study& study,
                                      const std::vector<std::string>& given) {
  experiments::FieldValues values;
  for (const std::string& one : given) {
    const std::size_t divider = one.find('=');
    if (divider == std::string::npos) {
      throw UsageError("--field: expected NAME=VALUE, found `" + one_line(one) + "`");
    }
    const std::string name = one.substr(0, divider);
    if (!values.emplace(name, one.substr(divider + 1)).second) {
      throw UsageError("--field: expected each field once, found `" + one_line(name) +
                       "` a second time");
    }
  }
  const std::string problem = experiments::field_problem(study, values);
  if (!problem.empty()) throw UsageError("--field: " + one_line(problem));
  return values;
}

experiments::FieldValues fields_or_none(const experiments::Study& study,
                                        const std::vector<std::string>& given) {
  return given.empty() ? experiments::FieldValues{} : fields_given(study, given);
}

}  // namespace jnd::app
