#pragma once

#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Throws `Error` naming the block if a study asks simulated participants for something for
/// which their laboratory, perhaps an older one, has no numbers.
void require_abilities(const Laboratory& laboratory, const Study& study);

}  // namespace jnd::experiments
