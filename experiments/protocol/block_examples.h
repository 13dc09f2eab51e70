#pragma once

#include <string>
#include <vector>

namespace jnd::experiments {

/// A block that the reader takes as it stands, in English.
struct BlockExample {
  std::string procedure;
  std::string json;
};

/// One or more for each procedure: schema, snippets of editors and reference documentation show
/// them.
[[nodiscard]] const std::vector<BlockExample>& block_examples();

}  // namespace jnd::experiments
