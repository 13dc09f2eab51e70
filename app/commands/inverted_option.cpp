#include "app/commands/inverted_option.h"

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

}  // namespace jnd::app
