#pragma once

namespace jnd::test_support {

/// Whether the code is instrumented, which makes it some ten times slower. Tests that repeat
/// the same code very often, to see a distribution or an accuracy, show nothing more then and
/// are skipped. Tests of many inputs take only some of these.
#if defined(JND_SANITIZED)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace jnd::test_support
