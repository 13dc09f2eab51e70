#pragma once

#include <string>
#include <vector>

namespace jnd::analysis {

/// A difference from what was planned before anybody took part.
struct Deviation {
  std::string topic;    ///< For example "number of participants" or "contrast fluids, alpha".
  std::string planned;  ///< What the preregistration says.
  std::string found;
};

/// How a study differs from its preregistration.
struct PreregisteredStudy {
  std::string registered_on;  ///< For example "2026-11-26"; "" if nothing was registered.
  std::string sha256;         ///< The SHA-256 of the preregistration.
  std::vector<Deviation> deviations;
};

}  // namespace jnd::analysis
