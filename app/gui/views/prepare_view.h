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

/// What the view before a session shows: who takes part, with which device, and whether
/// everything is ready.
struct PrepareModel {
  const StudyFolder& study;
  struct Device {
    std::string name, description;
    bool simulated = false;
  };
  std::vector<Device> devices;
  std::vector<std::string> languages;  ///< The languages of the study.
  /// What the study has to know about the participant.
  std::vector<experiments::ParticipantField> fields;
  /// The pseudonyms of past sessions and withdrawals, which cannot take part again.
  std::vector<std::string> taken;
  /// The cell that comes next, in words; "" if the study has one cell only, or if it is hidden.
  std::string assigned;
  std::uint64_t seed = 0;
  SoundModel sound;
  std::vector<PreflightLine> lines;
  bool looking = false;
  double progress = 0.0;
};

struct PrepareViewState {
  /// The next free pseudonym, as the application proposes it; the person may change it.
  std::string participant;
  bool pilot = false;
  /// A person chose the kind of session; otherwise a simulated device makes it a pilot.
  bool kind_is_chosen = false;
  std::string device;
  std::string language;
  /// The values chosen so far, by the field's name.
  std::map<std::string, std::string> fields;
  std::string fitting;       ///< As typed, such as "glove=M, thumb=thin pad"; may be empty.
  std::string sound_output;  ///< The output of the study's sound, or "off".
  float lines_height = 0, session_height = 0;
};

struct PrepareViewResult {
  StudyTab tab = StudyTab::kNone;
  bool start = false;       ///< Starts a session with what the state holds.
  bool look_again = false;  ///< Checks again; also set when the device was changed.
  bool fields_changed = false;
  SoundCardResult sound;
  /// Opens the dialog that shows and changes which pedal does what.
  bool map_controls = false;
};

/// Makes a session on a simulated device a pilot, and one on a real device none, unless a
/// person has chosen otherwise.
void choose_kind(const PrepareModel& model, PrepareViewState& state);

[[nodiscard]] PrepareViewResult draw_prepare_view(Ui& ui, const PrepareModel& model,
                                                  PrepareViewState& state);

}  // namespace jnd::app::gui
