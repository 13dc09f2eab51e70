#include "experiments/order/block_turns.h"

#include <algorithm>
#include <cstdint>

namespace jnd::experiments {

std::optional<std::size_t> next_turn(Turns turns, const std::vector<BlockProgress>& blocks,
                                     core::RandomStream& stream) {
  int fewest = 0, num_left = 0;
  for (const BlockProgress& block : blocks) {
    if (block.num_left <= 0) continue;
    fewest = num_left == 0 ? block.num_answered : std::min(fewest, block.num_answered);
    num_left += block.num_left;
  }
  if (num_left == 0) return std::nullopt;
  const auto weight_of = [&](const BlockProgress& block) {
    if (block.num_left <= 0) return 0;
    if (turns == Turns::kRandom) return block.num_left;
    return block.num_answered == fewest ? 1 : 0;
  };
  int sum = 0;
  for (const BlockProgress& block : blocks) sum += weight_of(block);
  auto drawn = static_cast<int>(stream.below(static_cast<std::uint64_t>(sum)));
  std::size_t index = 0;
  while (drawn >= weight_of(blocks[index])) drawn -= weight_of(blocks[index++]);
  return index;
}

core::RandomStream turn_stream(std::uint64_t seed, std::int64_t first_stage,
                               std::int64_t num_answered, std::int64_t num_put_off) {
  return {seed, "turn", {first_stage, num_answered, num_put_off}};
}

std::vector<std::size_t> all_turns(Turns turns, std::vector<int> num_trials, std::uint64_t seed,
                                   std::int64_t first_stage) {
  std::vector<BlockProgress> blocks;
  for (const int num : num_trials) blocks.push_back({.num_answered = 0, .num_left = num});
  std::vector<std::size_t> order;
  while (true) {
    core::RandomStream stream = turn_stream(seed, first_stage, std::ssize(order), 0);
    const std::optional<std::size_t> next = next_turn(turns, blocks, stream);
    if (!next) return order;
    order.push_back(*next);
    ++blocks[*next].num_answered;
    --blocks[*next].num_left;
  }
}

std::string to_string(Turns turns) { return turns == Turns::kRandom ? "random" : "rounds"; }

std::string turns_words(Turns turns) {
  return turns == Turns::kRandom ? "at random" : "in rounds";
}

std::size_t num_run_together(const std::vector<const Stage*>& stages, std::size_t first) {
  if (first >= stages.size() || !stages[first]->interleaving) return 1;
  std::size_t num = 1;
  // A group that comes twice in succession is run twice.
  while (first + num < stages.size() &&
         stages[first + num]->interleaving == stages[first]->interleaving &&
         stages[first + num]->name != stages[first]->name) {
    ++num;
  }
  return num;
}

}  // namespace jnd::experiments
