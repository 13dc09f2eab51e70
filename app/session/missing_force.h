#pragma once

#include <cstdint>
#include <string>

#include "core/force_counts.h"
#include "core/media/medium.h"

namespace jnd::app {

/// Whether a hand in it feels a force if it moves, or presses. Walls of a container alone do
/// not count: nobody has to touch them.
[[nodiscard]] bool asks_for_force(const core::MediumAmounts& medium) noexcept;

/// What was missing while something was felt and no force acted, a part of a sentence; "" where
/// a force acted. In English, and in the catalogue of the window's words.
[[nodiscard]] std::string missing_force_cause(const core::ForceCounts& meanwhile);

/// "no force acted in 3 presentations of stimuli that ask for one: CAUSE"; "" for none.
[[nodiscard]] std::string missing_force_words(std::int64_t num_presentations,
                                              const std::string& cause);

}  // namespace jnd::app
