#pragma once

namespace jnd::test_support {

/// Instrumented code is some ten times slower. Tests that go through the same code very many
/// times, to see a distribution or an accuracy, say nothing more there and are left out; tests
/// of many inputs take some of them.
#if defined(JND_SANITIZED)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace jnd::test_support
