#include "experiments/participants/abilities.h"

#include "core/error.h"
#include "experiments/participants/effects.h"
#include "experiments/procedures/magnitude_estimation.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

[[noreturn]] void lacks(const Laboratory& laboratory, const std::string& key,
                        const std::string& what, const std::string& block) {
  throw core::Error("laboratory " + laboratory.name + ": expected " + key + " for " + what +
                    " in the block " + block + ", found none; add it, with its basis");
}

}  // namespace

void require_abilities(const Laboratory& laboratory, const Study& study) {
  require_known_effects(laboratory, study);
  for_each_stage(study.stages, [&](const Stage& stage) {
    const auto* block = std::get_if<Block>(&stage.content);
    if (block == nullptr) return;
    const bool presses = block->is_pressed() || block->is_pressed_in("reference");
    if (presses && !laboratory.pressing) {
      lacks(laboratory, "/pressing", "the solid", stage.name);
    }
    if (modulus_of(*block) == Modulus::kFree && !laboratory.perceiver.free_modulus) {
      lacks(laboratory, "/perceiver/free_modulus", "numbers of one's own", stage.name);
    }
  });
}

}  // namespace jnd::experiments
