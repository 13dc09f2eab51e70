#pragma once

namespace jnd::core {

/// Words of the layers below the window that people read in it: the window shows them in its
/// own language (`tr` of app/language/words.h, whose catalogue collects them by this name).
/// They stay English for everybody else: reports, logs and the command line.
[[nodiscard]] constexpr const char* for_people(const char* english) noexcept { return english; }

}  // namespace jnd::core
