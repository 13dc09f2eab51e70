#pragma once

#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Throws `Error` naming the block if a study asks simulated participants for something that
/// their laboratory, which may be an older one, has no numbers for.
void require_abilities(const Laboratory& laboratory, const Study& study);

}  // namespace jnd::experiments
