#pragma once

namespace jnd::core {

/// Marks words of lower layers that people read in the window. The window shows them in its own
/// language, by `tr` of app/language/words.h, whose catalogue finds them by this function's
/// name. They stay English in logs and on the command line.
[[nodiscard]] constexpr const char* for_people(const char* english) noexcept { return english; }

}  // namespace jnd::core
