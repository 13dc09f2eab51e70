#pragma once

#include "core/error.h"

namespace jnd::core {

/// The system does not allow this user what was asked for: something that the environment
/// lacks, not a flaw of what was asked about.
class MissingRight : public Error {
 public:
  using Error::Error;
};

}  // namespace jnd::core
