#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/participants/laboratory.h"
#include "experiments/participants/perceiver.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// What a laboratory's effects do to the median person in a block with these levels: factors
/// multiplied, differences added, spreads left out.
[[nodiscard]] Laboratory::Effect effects_on(const Laboratory& laboratory, const Levels& levels);

/// The person as they are in a block with these levels. How much an effect does to a person is
/// drawn once in a session, whichever blocks it is felt in.
[[nodiscard]] Person affected(const Laboratory& laboratory, Person person,
                              std::uint64_t session_seed, const Levels& levels);

/// An effect as a command line gives it: "fluid=thin:weber_fraction_factor=2", levels and
/// amounts parted by commas. Throws `Error` that says what was expected and found.
[[nodiscard]] std::string with_effects(const std::string& laboratory_text,
                                       const std::vector<std::string>& effects);

/// The amounts of effects that change the answers of simulated people in such a block, as
/// `with_effects` reads them: "pse_factor" of comparisons, none of ratings.
[[nodiscard]] std::vector<std::string> amounts_that_act_on(const Block& block);

/// Throws `Error` where an effect names a factor or a level that the study has not, where no
/// block has all of its levels, or where one of its amounts changes nothing in any of the
/// blocks that have them.
void require_known_effects(const Laboratory& laboratory, const Study& study);

}  // namespace jnd::experiments
