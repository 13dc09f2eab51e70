#pragma once

#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "support/files.h"

namespace jnd::app {

/// Runs `jnd fit` on tables that the test writes.
class FitFixture : public CommandTest {
 protected:
  test_support::ProgramOutcome fit(std::vector<std::string> arguments, bool as_json = true) {
    arguments.insert(arguments.begin(), "fit");
    if (as_json) arguments.emplace_back("--json");
    return jnd(arguments);
  }
  void table(const char* name, const std::string& text) const {
    test_support::write_file(path(name), text);
  }
};

}  // namespace jnd::app
