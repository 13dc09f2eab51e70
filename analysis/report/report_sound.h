#pragma once

#include <string>

#include "analysis/report/report_methods.h"

namespace jnd::analysis {

/// What participants were to hear, and in how many sessions it was played; "" where the study
/// has no sound.
[[nodiscard]] std::string sound_words(const ChapterSource& source);

}  // namespace jnd::analysis
