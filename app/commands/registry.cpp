#include "app/command_line/command.h"

// clang-format off
// Every subcommand by the name of its function `add_NAME`, in the order of `jnd --help`.
#define JND_EVERY_SUBCOMMAND(ADD)                                          \
  /* A first look. */                                                      \
  ADD(demo)                                                                \
  /* Writing a study. */                                                   \
  ADD(validate) ADD(schema) ADD(new) ADD(plan) ADD(power) ADD(power_merge) \
  ADD(preregister)                                                         \
  /* Running it. */                                                        \
  ADD(run) ADD(simulate) ADD(resume) ADD(look)                             \
  /* Keeping it, and acts on what is kept. */                              \
  ADD(verify) ADD(backup) ADD(restore)                                     \
  ADD(exclude) ADD(unblind) ADD(withdraw) ADD(adverse_event)               \
  /* What came of it. */                                                   \
  ADD(results) ADD(report) ADD(export)                                     \
  /* Other people's data. */                                               \
  ADD(fit) ADD(compare)                                                    \
  /* The apparatus. */                                                     \
  ADD(force) ADD(loop) ADD(devices) ADD(device_check) ADD(commission)       \
  ADD(doctor) ADD(stability) ADD(characterize) ADD(device_simulator)        \
  ADD(device_server) ADD(device_key) ADD(sound)                             \
  /* The program itself. */                                                \
  ADD(manual) ADD(completions) ADD(man_pages)
// clang-format on

namespace jnd::app {

#define JND_DECLARE(name) void add_##name(CLI::App& program, Invocation& invocation);
JND_EVERY_SUBCOMMAND(JND_DECLARE)
#undef JND_DECLARE

const std::vector<Registration>& registrations() {
#define JND_LIST(name) add_##name,
  static const std::vector<Registration> kAll = {JND_EVERY_SUBCOMMAND(JND_LIST)};
#undef JND_LIST
  return kAll;
}

}  // namespace jnd::app
