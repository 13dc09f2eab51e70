#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/random_stream.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// How far a block of a group has come.
struct BlockProgress {
  int num_answered = 0;
  int num_left = 0;  ///< Trials to come, as far as they are known; 0: it is done.
};

/// Index of the block whose trial comes next; none where all are done. In rounds it is one of
/// those with the fewest answers, so that a trial that comes again keeps nobody waiting; at
/// random each has the weight of what it has left. Not real time.
[[nodiscard]] std::optional<std::size_t> next_turn(Turns turns,
                                                   const std::vector<BlockProgress>& blocks,
                                                   core::RandomStream& stream);

/// The stream of a group's next turn: of the session's seed, the first stage of the group, and
/// what its blocks have come to. An answer that is taken back and given anew changes no turn.
[[nodiscard]] core::RandomStream turn_stream(std::uint64_t seed, std::int64_t first_stage,
                                             std::int64_t num_answered,
                                             std::int64_t num_put_off);

/// The turns of a whole group, as indices of its blocks, where nothing but their lengths
/// decides. `num_trials` of each block.
[[nodiscard]] std::vector<std::size_t> all_turns(Turns turns, std::vector<int> num_trials,
                                                 std::uint64_t seed, std::int64_t first_stage);

/// As the study file writes it: "rounds".
[[nodiscard]] std::string to_string(Turns turns);
/// As a sentence has it: "in rounds", "at random".
[[nodiscard]] std::string turns_words(Turns turns);

/// How many stages from this one on are run as one: the blocks of a group, else 1. `first` is
/// the place of a stage in a participant's own list.
[[nodiscard]] std::size_t num_run_together(const std::vector<const Stage*>& stages,
                                           std::size_t first);

}  // namespace jnd::experiments
