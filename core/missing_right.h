#pragma once

#include "core/error.h"

namespace jnd::core {

/// The system does not grant this user a right. The environment lacks something; what the user
/// asked about has no flaw.
class MissingRight : public Error {
 public:
  using Error::Error;
};

}  // namespace jnd::core
