#pragma once

#include "experiments/participants/laboratory.h"
#include "support/places.h"

namespace jnd::experiments {

/// Returns the shipped laboratory with people like those of the thesis, on the device that has
/// no joints.
inline Laboratory thesis_laboratory() {
  return read_laboratory(test_support::source_folder() / "data/laboratories/thesis.json");
}

}  // namespace jnd::experiments
