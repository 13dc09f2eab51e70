#pragma once

#include <string>
#include <vector>

namespace jnd::experiments {

/// A block that the reader accepts as it is, in English.
struct BlockExample {
  std::string procedure;
  std::string json;
};

/// Returns one or more for each procedure. Schema, snippets of editors and reference
/// documentation show them.
[[nodiscard]] const std::vector<BlockExample>& block_examples();

}  // namespace jnd::experiments
