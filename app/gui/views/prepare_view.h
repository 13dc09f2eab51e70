#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/ui.h"
#include "app/gui/views/sound_card.h"
#include "app/gui/views/study_tabs.h"
#include "app/operator/preflight.h"
#include "app/operator/study_folder.h"
#include "experiments/study/study.h"

namespace jnd::app::gui {

/// What stands before a session: who, with which device, and whether everything is ready.
struct PrepareModel {
  const StudyFolder& study;
  struct Device {
    std::string name, description;
    bool simulated = false;
  };
  std::vector<Device> devices;
  std::vector<std::string> languages;  ///< Of the study.
  /// Of the study: what has to be known of the participant.
  std::vector<experiments::ParticipantField> fields;
  /// Who is taken, sessions and withdrawals alike, and so cannot take part again.
  std::vector<std::string> taken;
  std::string assigned;  ///< The cell that comes next, in words; "" for one cell or hidden.
  std::uint64_t seed = 0;
  SoundModel sound;
  std::vector<PreflightLine> lines;
  bool looking = false;
  double progress = 0.0;
};

struct PrepareViewState {
  std::string participant;  ///< Proposed by the application: the next free pseudonym.
  bool pilot = false;
  bool kind_is_chosen = false;  ///< By a person; else a simulated device means a pilot.
  std::string device;
  std::string language;
  std::map<std::string, std::string> fields;  ///< Chosen so far: name to value.
  std::string fitting;       ///< Typed: "glove=M, thumb=thin pad"; may be empty.
  std::string sound_output;  ///< Where the study's sound goes to, or "off".
  float lines_height = 0, session_height = 0;
};

struct PrepareViewResult {
  StudyTab tab = StudyTab::kNone;
  bool start = false;       ///< With what the state holds.
  bool look_again = false;  ///< Also after the device was changed.
  bool fields_changed = false;
  SoundCardResult sound;
  bool map_controls = false;  ///< Which pedal does what is to be seen, or changed.
};

/// A session on a simulated device is a pilot, one on a real device is not, unless a person has
/// chosen otherwise.
void choose_kind(const PrepareModel& model, PrepareViewState& state);

[[nodiscard]] PrepareViewResult draw_prepare_view(Ui& ui, const PrepareModel& model,
                                                  PrepareViewState& state);

}  // namespace jnd::app::gui
