#include "app/commands/commands.h"

namespace jnd::app {

const std::vector<Registration>& registrations() {
  static const std::vector<Registration> kAll = {};
  return kAll;
}

}  // namespace jnd::app
