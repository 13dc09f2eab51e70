#include "app/sound/sound_outputs.h"

#include <algorithm>

#include "device/sound/alsa_output.h"

namespace jnd::app {

std::vector<KnownOutput> known_outputs(const SoundSettings& settings,
                                       const std::string& asked) {
  std::vector<KnownOutput> known;
  const auto add = [&](const std::string& name, const std::string& description) {
    const bool is_there = std::ranges::find(known, name, &KnownOutput::name) != known.end();
    if (!name.empty() && !is_there) {
      known.push_back({name, description, settings.calibration_of(name)});
    }
  };
  for (const device::SoundOutputEntry& entry : device::alsa_outputs()) {
    add(entry.name, entry.description);
  }
  const std::string chosen = settings.output();
  add(chosen, "");
  add(asked, "");
  for (KnownOutput& one : known) one.is_chosen = one.name == chosen;
  return known;
}

}  // namespace jnd::app
