#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/data/study_data.h"

namespace jnd::analysis {

/// Two names of blocks whose Weber fractions are compared, the first minus the second.
using BlockNames = std::pair<std::string, std::string>;

/// Two blocks to be compared.
struct ComparedBlocks {
  BlockDesign first, second;
  /// Its test by the primary values is primary; else both measure by different means, and the
  /// study has better pairs. No word on whether anybody planned it: see `kPairsFamily`.
  bool has_primary = false;
};

/// Those with a psychometric function over comparisons, in their order.
[[nodiscard]] std::vector<BlockDesign> comparing_blocks(const StudyData& data);

/// Which of these blocks, all with a psychometric function, are compared.
///
/// Those that were asked for, and no others. Where none were, every two blocks of one quantity;
/// of more than five such blocks, each with the next. A primary test have those asked for, and
/// those with one procedure and one task: others measure by different means, and have one only
/// where the study has nothing better. Throws `Error` where one asked for is not among the
/// blocks, or both are of different quantities.
[[nodiscard]] std::vector<ComparedBlocks> compared_blocks(
    const std::vector<BlockDesign>& blocks, const std::vector<BlockNames>& asked);

}  // namespace jnd::analysis
