#pragma once

#include "app/command_line/command.h"

namespace jnd::app {

void add_validate(CLI::App& program, Invocation& invocation);
void add_schema(CLI::App& program, Invocation& invocation);
void add_new(CLI::App& program, Invocation& invocation);
void add_plan(CLI::App& program, Invocation& invocation);
void add_power(CLI::App& program, Invocation& invocation);
void add_power_merge(CLI::App& program, Invocation& invocation);
void add_fit(CLI::App& program, Invocation& invocation);
void add_compare(CLI::App& program, Invocation& invocation);
void add_force(CLI::App& program, Invocation& invocation);
void add_loop(CLI::App& program, Invocation& invocation);
void add_devices(CLI::App& program, Invocation& invocation);
void add_device_simulator(CLI::App& program, Invocation& invocation);
void add_device_key(CLI::App& program, Invocation& invocation);
void add_stability(CLI::App& program, Invocation& invocation);
void add_characterize(CLI::App& program, Invocation& invocation);
void add_run(CLI::App& program, Invocation& invocation);
void add_resume(CLI::App& program, Invocation& invocation);
void add_simulate(CLI::App& program, Invocation& invocation);
void add_demo(CLI::App& program, Invocation& invocation);
void add_results(CLI::App& program, Invocation& invocation);
void add_report(CLI::App& program, Invocation& invocation);
void add_exclude(CLI::App& program, Invocation& invocation);
void add_unblind(CLI::App& program, Invocation& invocation);
void add_backup(CLI::App& program, Invocation& invocation);
void add_restore(CLI::App& program, Invocation& invocation);
void add_adverse_event(CLI::App& program, Invocation& invocation);
void add_withdraw(CLI::App& program, Invocation& invocation);
void add_verify(CLI::App& program, Invocation& invocation);
void add_export(CLI::App& program, Invocation& invocation);
void add_doctor(CLI::App& program, Invocation& invocation);

}  // namespace jnd::app
