#include "app/commands/commands.h"

namespace jnd::app {

const std::vector<Registration>& registrations() {
  static const std::vector<Registration> kAll = {
      add_demo, add_validate, add_schema, add_new,     add_plan,
      add_run,  add_simulate, add_resume, add_results,
  };
  return kAll;
}

}  // namespace jnd::app
