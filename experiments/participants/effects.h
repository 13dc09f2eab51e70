#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/participants/laboratory.h"
#include "experiments/participants/perceiver.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Returns the combined effects of a laboratory on the median person in a block with these
/// levels: factors are multiplied, differences are added, and spreads are left out.
[[nodiscard]] Laboratory::Effect effects_on(const Laboratory& laboratory, const Levels& levels);

/// Returns the person with the effects in a block with these levels. The size of an effect is
/// drawn once for a person in a session, whatever the number of blocks with it.
[[nodiscard]] Person affected(const Laboratory& laboratory, Person person,
                              std::uint64_t session_seed, const Levels& levels);

/// Adds effects that are given as on a command line: "fluid=thin:weber_fraction_factor=2", with
/// levels and amounts separated by commas. Throws `Error` that says what was expected and
/// found.
[[nodiscard]] std::string with_effects(const std::string& laboratory_text,
                                       const std::vector<std::string>& effects);

/// Returns the amounts of effects that change the answers of simulated people in such a block,
/// as `with_effects` reads them. For example, "pse_factor" acts on comparisons and not on
/// ratings.
[[nodiscard]] std::vector<std::string> amounts_that_act_on(const Block& block);

/// Throws `Error` if an effect names a factor or a level that the study lacks, if no block has
/// all of its levels, or if one of its amounts changes nothing in any of the blocks that have
/// them.
void require_known_effects(const Laboratory& laboratory, const Study& study);

}  // namespace jnd::experiments
