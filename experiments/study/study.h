#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/marker.h"
#include "core/media/force_map.h"
#include "core/media/immersion.h"
#include "experiments/study/design.h"
#include "experiments/study/settings.h"
#include "experiments/study/sound.h"

namespace jnd::experiments {

/// What else a study says of a medium, by the keys of `medium_details()`: of a solid
/// "friction_ratio". A value that is the default is not in it.
using MediumDetails = std::map<std::string, double, std::less<>>;

/// A medium as a study names it, with its one varied quantity.
struct MediumSetting {
  std::string medium;    ///< One of `media()`: "free_space", "water", "viscous", "solid" ...
  std::string quantity;  ///< "scale", "viscosity_pa_s", "stiffness_n_per_m"; "" for free_space.
  double intensity = 0.0;  ///< In the unit of `quantity`.
  MediumDetails details;
  bool operator==(const MediumSetting&) const = default;
};

/// A medium that is explored for some time outside of any trial.
struct Exploration {
  MediumSetting setting;
  double duration_s = 0.0;  ///< > 0.
  Text say;                 ///< A sentence for the experimenter to say; may be empty.
};

struct ChecklistItem {
  Text text;
  Text say;  ///< A sentence for the experimenter to say word for word; may be empty.
};

struct Checklist {
  std::vector<ChecklistItem> items;
};

struct Consent {
  std::vector<Text> paragraphs;
  Text agreement;  ///< The sentence to which the participant agrees.
};

/// Free exploration, for example of free space, before anything is asked.
struct Explore {
  Text instruction;
  std::vector<Exploration> media;
};

/// Example stimuli that show the coming range. There are no answers.
struct Training {
  Text instruction;
  std::vector<Exploration> examples;
};

/// Trials until a participant can do the task. They are run and stored like others, but are no
/// data.
struct Practice {
  /// Share of the judged answers that have to be right, (0, 1].
  double min_correct_ratio = 0.0;
  int num_trials_judged = 0;  ///< How many of the last answers are judged, >= 1.
  int max_trials = 0;         ///< The block ends after this many trials in any case.
};

/// One answer to choose from. The value is stored, whatever language is shown.
struct Option {
  std::string value;  ///< [a-z0-9_]+, unique in its item.
  Text label;
};

/// A question of a questionnaire, or one after every trial of a block.
struct QuestionnaireItem {
  std::string name;
  std::string kind;  ///< "number", "text", "choice", "yes_no", "yes_no_which" or "scale".
  Text question;
  std::string unit;  ///< For the kind number; may be empty.
  /// For the kind number: limits of possible values, in `unit`.
  std::optional<double> minimum, maximum;
  std::vector<Option> options;  ///< For the kind choice, at least two.
  int num_steps = 10;           ///< For the kind scale.
  Text low_label, high_label;   ///< For the kind scale: labels of step 1 and of the last step.
  /// For the kind scale: which end is the favourable one; none if neither is.
  std::optional<bool> high_is_good{};
  bool required = true;
};

/// The order of the stimuli of a block. Each repetition shows every one of them once.
struct StimulusOrder {
  enum class Method {
    kShuffled,  ///< Each repetition by itself in random order.
    kMixed,     ///< All repetitions together in random order.
    kLatin,     ///< Rows of a cyclic Latin square, over participants and repetitions.
    kWilliams,  ///< Rows of a Williams square, over participants and repetitions.
  };
  Method method = Method::kShuffled;
  std::optional<int> max_in_a_row;  ///< Trials of one stimulus in a row, >= 1. Not for squares.
  /// Distance from a stimulus to its next trial, >= 1. Only for `kShuffled`.
  int min_distance = 1;
  std::vector<double> not_first;  ///< Stimuli that do not open the block. Not for squares.
  /// Row of the square for the first repetition; see `block_of`.
  std::size_t row = 0;
};

/// One procedure over one varied quantity. Blocks give the data of a study.
struct Block {
  std::string
      procedure;       ///< "magnitude_estimation", "magnitude_production", "constant_stimuli".
  std::string medium;  ///< One of `media()` but free space.
  std::string quantity;   ///< "scale", "viscosity_pa_s" or "stiffness_n_per_m".
  MediumDetails details;  ///< Of its medium.
  Text instruction;
  Text question;             ///< The question to the participant in every trial.
  Text yes_label, no_label;  ///< Names of the two answers; may be empty.
  Text first_label, second_label, third_label;  ///< Names of the intervals; may be empty.
  Text low_label, high_label;       ///< For a rating: labels of the ends of the scale.
  std::vector<double> intensities;  ///< Test stimuli, or starting values of an adjustment.
  std::optional<double> reference_intensity;  ///< For constant stimuli.
  std::string standard_medium;                ///< Medium of the standard; "" if there is none.
  std::vector<double> standards;              ///< In the unit of `standard_medium`, each > 0.
  /// For a production, which has one repetition for each target.
  std::vector<double> target_percent;
  int repetitions = 1;  ///< Each shows every intensity once; 1 in a production.
  StimulusOrder order;
  /// For an adjustment, in the unit of the quantity, > fine_step.
  double coarse_step = 0.0;
  double fine_step = 0.0;               ///< For an adjustment, > 0.
  std::optional<double> max_intensity;  ///< For an adjustment: no step goes beyond it.
  double free_space_between_s = 0.0;    ///< Duration of free space before each trial, >= 0.
  double expected_trial_s = 0.0;        ///< To plan the length of a session, > 0.
  /// Shortest time before anybody can answer or go on, >= 0.
  double min_stimulus_s = 0.0;
  /// A stimulus ends after this time, >= `min_stimulus_s`.
  std::optional<double> max_stimulus_s;
  std::optional<double> answer_deadline_s;  ///< Later answers are missed, > 0.
  /// Largest number of returns to stimuli in a trial, >= 0.
  std::optional<int> max_returns;
  bool feedback = false;             ///< Each answer is followed by "right" or "wrong".
  bool cannot_tell = false;          ///< "Cannot tell" is an answer, too.
  std::optional<Practice> practice;  ///< If set, the block is practice, and no data.
  Levels levels;                     ///< Levels of the study's factors; may be empty.
  /// Participants answer by a control of their own and do not tell the experimenter.
  bool participant_answers = false;
  /// Questions after the answer to every trial, in this order, before the next trial may begin.
  std::vector<QuestionnaireItem> questions;
  std::optional<MaskingNoise> masking_noise{};  ///< Replaces the study's; see `sound_of`.
  std::optional<std::vector<Cue>> cues{};       ///< Replaces the study's; see `sound_of`.
  Settings settings;                            ///< All of the procedure's own keys.

  /// Whether the medium is a surface that is pressed and not a fluid that is stroked through.
  [[nodiscard]] bool is_pressed() const;
  /// Whether an interval holds such a surface. The interval "reference" does in a block with a
  /// solid standard.
  [[nodiscard]] bool is_pressed_in(std::string_view interval) const;
};

struct Break {
  Text instruction;
  double duration_s = 0.0;  ///< Shortest rest, >= 0.
};

struct PostExperimentItem {
  std::string name;
  MediumSetting setting;
  Text instruction;
  Text question;
  std::string answer;  ///< "yes_no", "text" or "words".
  int num_words = 0;   ///< Number of words for which "words" asks.
};

struct PostExperiment {
  std::vector<PostExperimentItem> items;
};

struct Questionnaire {
  Text instruction;
  std::vector<QuestionnaireItem> items;
};

struct Stage;

/// Alternatives between participants. With `order` and `latin` every arm is run, and the order
/// of the arms is part of the cell. With `one_of` each participant gets one arm.
struct Counterbalance {
  struct Arm {
    std::string name;
    std::vector<Stage> stages;
  };
  enum class Method { kOrder, kLatin, kOneOf };
  Method method = Method::kOrder;
  std::vector<Arm> arms;
  /// Stages that run between two arms of an order, for example a break.
  std::vector<Stage> between;
  /// Field within whose values it is balanced; "" for all participants together.
  std::string stratify_by;
};

/// How the blocks of a group take turns, trial by trial.
enum class Turns {
  kRounds,  ///< In a round each block that has trials left comes once, in drawn order.
  kRandom,  ///< Each trial is drawn from all that are left, whatever their block.
};

/// A group of blocks whose trials are mixed. Each of its blocks has a copy.
struct Interleaving {
  std::string name;  ///< Name of the group, which is unique in the study, also among stages.
  Text title;        ///< May be empty.
  Turns turns = Turns::kRounds;

  friend bool operator==(const Interleaving&, const Interleaving&) = default;
};

struct Stage {
  std::string name;  ///< Unique in the study; [a-z0-9_]+.
  Text title;        ///< May be empty.
  /// The stage runs only for participants of these arms: name of a `one_of` counterbalance to
  /// name of its arm. If empty, it runs for everyone.
  std::map<std::string, std::string> only_for;
  std::variant<Checklist, Consent, Explore, Training, Block, Break, PostExperiment,
               Questionnaire, Counterbalance>
      content;
  int line = 0;  ///< Its line in the file, for messages.
  /// Set for a block whose trials are mixed with those of others. The blocks of a group are
  /// adjacent in every list of stages.
  std::optional<Interleaving> interleaving{};
};

enum class Blinding { kNone, kParticipant, kDouble };

/// What a study requires of the apparatus.
struct DeviceNeeds {
  int min_contact_points = 5;
  double rate_hz = 1000.0;
  double ramp_s = 0.050;
  double max_missed_ratio = 0.01;  ///< Share of a presentation's ticks, [0, 1].
  /// An infinite surface unless the study says otherwise.
  core::Immersion immersion;
  double wall_stiffness_n_per_m = 0.0;  ///< Wall at the limits of the immersion; 0 for no wall.
  double wall_friction_ratio = 0.0;     ///< >= 0.
  std::vector<core::ForceMap::Row> force_map;  ///< If empty, the thesis's fit is used.
};

/// A property of a participant that is known before the session, by which counterbalances can
/// be stratified.
struct ParticipantField {
  std::string name;
  Text question;
  std::vector<Option> options;
};

/// What can be demanded of a participant in one session.
struct SessionLimits {
  std::optional<double> max_duration_s;         ///< > 0.
  std::optional<int> max_trials_without_break;  ///< >= 1.
  std::optional<double> max_force_time_n_s;     ///< > 0; see `core::Exposure`.
  std::optional<double> max_under_force_s;      ///< > 0; see `core::Exposure`.

  [[nodiscard]] bool limits_exposure() const noexcept {
    return max_force_time_n_s || max_under_force_s;
  }
};

/// A study file, checked and with all defaults.
struct Study {
  int format = 1;
  std::string name;  ///< [a-z0-9_]+
  /// Every text has exactly these languages; the first one is shown.
  std::vector<std::string> languages;
  Text title;
  Text description;  ///< May be empty.
  std::vector<std::string> authors;
  std::string citation;  ///< Citation of the study that it follows; may be empty.
  DeviceNeeds device;
  Blinding blinding = Blinding::kNone;
  SessionLimits session_limits;
  /// Heard in the whole study except where a block says otherwise; see `sound_of`.
  Sound sound;
  core::MarkerCodes markers;  ///< Codes of the pulses that are sent to another recorder.
  std::vector<ParticipantField> participant_fields;
  std::vector<DesignFactor> factors;
  std::vector<PlannedContrast> contrasts;
  /// None if nobody looks at the data before all have taken part.
  std::optional<SequentialPlan> sequential;
  std::vector<Stage> stages;
  std::string text;  ///< The file word for word; its SHA-256 identifies the study.
};

}  // namespace jnd::experiments
