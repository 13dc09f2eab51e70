#include "analysis/data/compared_blocks.h"

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "experiments/procedures/task.h"

namespace jnd::analysis {
namespace {

const BlockDesign& named(const std::vector<BlockDesign>& blocks, const std::string& name) {
  const auto found = std::ranges::find(blocks, name, &BlockDesign::block);
  if (found != blocks.end()) return *found;
  std::string names;
  for (const BlockDesign& block : blocks) names += (names.empty() ? "" : ", ") + block.block;
  throw core::Error("--compare: expected two of the blocks with a Weber fraction (" +
                    (names.empty() ? "there is none" : names) + "), found `" + name + "`");
}

std::vector<ComparedBlocks> asked_for(const std::vector<BlockDesign>& blocks,
                                      const std::vector<BlockNames>& asked) {
  std::vector<ComparedBlocks> pairs;
  for (const auto& [first, second] : asked) {
    ComparedBlocks pair{named(blocks, first), named(blocks, second), /*has_primary=*/true};
    if (first == second) {
      throw core::Error("--compare: expected two different blocks, found `" + first +
                        "` twice");
    }
    if (pair.first.quantity != pair.second.quantity) {
      throw core::Error("--compare: expected two blocks of the same quantity, found " +
                        pair.first.quantity + " in `" + first + "` and " +
                        pair.second.quantity + " in `" + second + "`");
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

bool measure_alike(const BlockDesign& one, const BlockDesign& other) {
  return one.procedure == other.procedure && task_of(one.written) == task_of(other.written);
}

}  // namespace

std::vector<BlockDesign> comparing_blocks(const StudyData& data) {
  std::vector<BlockDesign> found;
  std::ranges::copy_if(data.blocks, std::back_inserter(found), &BlockDesign::compares);
  return found;
}

std::vector<ComparedBlocks> compared_blocks(const std::vector<BlockDesign>& blocks,
                                            const std::vector<BlockNames>& asked) {
  if (!asked.empty()) return asked_for(blocks, asked);
  constexpr std::ptrdiff_t kMostOfEveryTwo = 5;
  std::vector<ComparedBlocks> pairs;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const bool with_all = std::ranges::count(blocks, blocks[i].quantity,
                                             &BlockDesign::quantity) <= kMostOfEveryTwo;
    for (std::size_t j = i + 1; j < blocks.size(); ++j) {
      if (blocks[i].quantity != blocks[j].quantity) continue;
      pairs.push_back({blocks[i], blocks[j], measure_alike(blocks[i], blocks[j])});
      if (!with_all) break;
    }
  }
  const bool any_primary = std::ranges::any_of(pairs, &ComparedBlocks::has_primary);
  for (ComparedBlocks& pair : pairs) pair.has_primary |= !any_primary;
  return pairs;
}

}  // namespace jnd::analysis
