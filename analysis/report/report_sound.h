#pragma once

#include <string>

#include "analysis/report/report_methods.h"

namespace jnd::analysis {

/// What participants were meant to hear, and in how many sessions it was played; "" if the
/// study has no sound.
[[nodiscard]] std::string sound_words(const ChapterSource& source);

}  // namespace jnd::analysis
