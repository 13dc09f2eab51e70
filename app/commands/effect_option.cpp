#include "app/commands/effect_option.h"

#include "app/command_line/command.h"
#include "app/session/shipped_files.h"
#include "core/error.h"
#include "experiments/participants/effects.h"

namespace jnd::app {

void add_effect_option(CLI::App& command, std::vector<std::string>& given) {
  command
      .add_option(
          "--effect", given,
          "What a condition does to simulated people, once for each: levels of the "
          "study's factors, of its counterbalances or of `block`, then amounts, such as "
          "fluid=thin:weber_fraction_factor=2,weber_fraction_sd_ln=0.2. Amounts are "
          "weber_fraction_factor, pse_factor, exponent_difference, magnitude_factor, "
          "rating_difference in steps, and how people differ in them: weber_fraction_sd_ln, "
          "pse_sd_ln, exponent_sd, magnitude_sd_ln, rating_sd")
      ->type_name("LEVELS:AMOUNTS");
}

experiments::Laboratory laboratory_with_effects(const std::string& laboratory,
                                                const std::vector<std::string>& effects) {
  const auto file = user_or_shipped(laboratory, "data/laboratories");
  experiments::Laboratory read = experiments::read_laboratory(file);
  if (effects.empty()) return read;
  try {
    return experiments::parse_laboratory(experiments::with_effects(read.text, effects),
                                         "--effect");
  } catch (const core::Error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace jnd::app
