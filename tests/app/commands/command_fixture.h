#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/storage/study_store.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {

/// Runs the program in a folder of its own, which is removed with the test.
class CommandTest : public ::testing::Test {
 protected:
  test_support::ProgramOutcome jnd(const std::vector<std::string>& words) const {
    return test_support::run_program(words, options_);
  }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const {
    return temporary_.path() / name;
  }
  [[nodiscard]] core::StudyStore opened(const std::string& study) const {
    return {path(study), core::StudyStore::Mode::kReadOnly};
  }
  [[nodiscard]] int num_events(const std::string& study, int session,
                               const std::string& kind) const {
    return static_cast<int>(
        std::ranges::count(opened(study).events(session), kind, &core::EventRow::kind));
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  test_support::ProgramOptions options_{.folder = temporary_.path(), .environment = {}};
};

}  // namespace jnd::app
