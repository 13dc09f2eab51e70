#include "app/inverted_option.h"

#include "analysis/inverted_answers.h"

namespace jnd::app {

void add_inverted_option(CLI::App& command, std::string& given) {
  given = "in";
  command
      .add_option("--inverted", given,
                  "People who answer the wrong way round in a block: in its numbers, with a "
                  "caution, or out")
      ->check(CLI::IsMember({"in", "out"}))
      ->type_name("in|out")
      ->capture_default_str();
}

void apply_inverted_option(const std::string& given, analysis::StudyData& data) {
  if (given == "out") analysis::leave_out_inverted(data);
}

}  // namespace jnd::app
