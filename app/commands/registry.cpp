#include "app/commands/commands.h"

namespace jnd::app {

const std::vector<Registration>& registrations() {
  static const std::vector<Registration> kAll = {
      add_demo,  // A first look.
      add_validate,      add_schema,       add_new,
      add_plan,          add_power,        add_power_merge,  // Writing a study.
      add_run,           add_simulate,     add_resume,       // Running it.
      add_verify,        add_backup,       add_restore,      // Keeping it.
      add_exclude,       add_unblind,      add_withdraw,
      add_adverse_event,                                // Acts on what is kept.
      add_results,       add_report,       add_export,  // What came of it.
      add_fit,           add_compare,                   // Other people's data.
      add_force,         add_loop,         add_devices,
      add_doctor,  // The apparatus.
      add_stability,     add_characterize, add_device_simulator,
      add_device_key,
  };
  return kAll;
}

}  // namespace jnd::app
