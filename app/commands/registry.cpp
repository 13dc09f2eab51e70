#include "app/commands/commands.h"

namespace jnd::app {

const std::vector<Registration>& registrations() {
  static const std::vector<Registration> kAll = {
      add_demo, add_run, add_resume, add_simulate, add_results,
  };
  return kAll;
}

}  // namespace jnd::app
