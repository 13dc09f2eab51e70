#pragma once

#include <string>
#include <vector>

namespace jnd::analysis {

/// Something that is not as it was planned before anybody took part.
struct Deviation {
  std::string topic;    ///< "number of participants", "contrast fluids, alpha".
  std::string planned;  ///< As the preregistration has it.
  std::string found;
};

/// How a study came out beside its preregistration.
struct PreregisteredStudy {
  std::string registered_on;  ///< "2026-11-26"; "" where nothing was registered.
  std::string sha256;         ///< Of the preregistration.
  std::vector<Deviation> deviations;
};

}  // namespace jnd::analysis
