#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// The names of two blocks whose Weber fractions are compared, the first minus the second.
using BlockNames = std::pair<std::string, std::string>;

/// Two blocks that are compared.
struct ComparedBlocks {
  BlockDesign first, second;
  /// Whether the test by their primary values is primary. If not, the blocks measure by
  /// different methods and the study has better pairs. This does not say whether anybody
  /// planned the test; see `kPairsFamily`.
  bool has_primary = false;
};

/// The blocks with a psychometric function over comparisons, in their order.
[[nodiscard]] std::vector<BlockDesign> comparing_blocks(const StudyData& data);

/// Which of these blocks, which all have a psychometric function, are compared.
///
/// These are the pairs that were asked for. If none were asked for, they are every two blocks
/// of one quantity or, for more than five such blocks, each with the next. Pairs that were
/// asked for have a primary test. So do pairs with the same procedure and task. Other pairs
/// measure by different methods, and have a primary test only if the study has no better pairs.
/// Throws `Error` if a requested block is not among the blocks, or if both are of different
/// quantities.
[[nodiscard]] std::vector<ComparedBlocks> compared_blocks(
    const std::vector<BlockDesign>& blocks, const std::vector<BlockNames>& asked);

}  // namespace jnd::analysis
