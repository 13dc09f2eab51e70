#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace jnd::test_support {

/// Returns whether the condition becomes true within ten seconds. This is far longer than any
/// working machine needs.
[[nodiscard]] inline bool comes_about(const std::function<bool()>& it) {
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!it()) {
    if (std::chrono::steady_clock::now() > patience) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace jnd::test_support
