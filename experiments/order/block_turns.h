#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/random_stream.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// The progress of a block in a group.
struct BlockProgress {
  int num_answered = 0;
  int num_left = 0;  ///< Known number of trials to come; 0 if the block is done.
};

/// Draws the index of the block whose trial comes next, or none if all are done. In rounds it
/// is one of the blocks with the fewest answers, so that a trial that has to be repeated delays
/// no block. At random each block has the weight of its remaining trials. Not real time.
[[nodiscard]] std::optional<std::size_t> next_turn(Turns turns,
                                                   const std::vector<BlockProgress>& blocks,
                                                   core::RandomStream& stream);

/// Returns the stream for a group's next turn. It depends on the session's seed, the first
/// stage of the group and the progress of its blocks. An answer that is taken back and given
/// again changes no turn.
[[nodiscard]] core::RandomStream turn_stream(std::uint64_t seed, std::int64_t first_stage,
                                             std::int64_t num_answered,
                                             std::int64_t num_put_off);

/// Returns the turns of a whole group as indices of its blocks, for blocks whose lengths are
/// fixed. `num_trials` has a number for each block.
[[nodiscard]] std::vector<std::size_t> all_turns(Turns turns, std::vector<int> num_trials,
                                                 std::uint64_t seed, std::int64_t first_stage);

/// Returns the spelling of the study file: "rounds".
[[nodiscard]] std::string to_string(Turns turns);
/// Returns words for a sentence: "in rounds", "at random".
[[nodiscard]] std::string turns_words(Turns turns);

/// Returns how many stages from this one on are run together: the blocks of a group, or 1.
/// `first` is the index of a stage in a participant's own list.
[[nodiscard]] std::size_t num_run_together(const std::vector<const Stage*>& stages,
                                           std::size_t first);

}  // namespace jnd::experiments
