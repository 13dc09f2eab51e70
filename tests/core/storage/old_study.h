#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "support/places.h"

namespace jnd::core {

/// Makes `folder` and copies the study of an older layout (see README.md) into it.
inline void copy_old_study(std::int64_t layout, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const fs::path here = test_support::source_folder() / "tests" / "core" / "storage";
  fs::create_directories(folder);
  fs::copy(here / "layout_1" / "recordings", folder / "recordings");
  fs::copy(here / ("layout_" + std::to_string(layout)) / "study.sqlite", folder);
}

}  // namespace jnd::core
