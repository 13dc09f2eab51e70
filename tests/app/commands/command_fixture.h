#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/storage/study_store.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {

/// Runs the program in a temporary folder, which is deleted after the test.
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

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  test_support::ProgramOptions options_{.folder = temporary_.path(), .environment = {}};
};

}  // namespace jnd::app
