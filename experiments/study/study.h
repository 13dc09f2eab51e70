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

/// A medium to be explored for some time outside of any trial.
struct Exploration {
  MediumSetting setting;
  double duration_s = 0.0;  ///< > 0.
  Text say;                 ///< Sentence for the experimenter to say; may be empty.
};

struct ChecklistItem {
  Text text;
  Text say;  ///< Sentence to say word for word; may be empty.
};

struct Checklist {
  std::vector<ChecklistItem> items;
};

struct Consent {
  std::vector<Text> paragraphs;
  Text agreement;  ///< The one sentence that is agreed to.
};

/// Free exploration, for example of free space, before anything is asked.
struct Explore {
  Text instruction;
  std::vector<Exploration> media;
};

/// Example stimuli that show the range to come; nothing is scored.
struct Training {
  Text instruction;
  std::vector<Exploration> examples;
};

/// Trials until somebody can do a task; they are run and stored as any, and are no data.
struct Practice {
  double min_correct_ratio = 0.0;  ///< Of the answers judged that have to be right, (0, 1].
  int num_trials_judged = 0;       ///< The last ones, >= 1.
  int max_trials = 0;              ///< The block ends after so many in any case.
};

/// One answer to choose from. The value is what is stored, whatever the language shown.
struct Option {
  std::string value;  ///< [a-z0-9_]+, unique in its item.
  Text label;
};

/// A question of a questionnaire, or one that follows every trial of a block.
struct QuestionnaireItem {
  std::string name;
  std::string kind;  ///< "number", "text", "choice", "yes_no", "yes_no_which" or "scale".
  Text question;
  std::string unit;                        ///< kind number; may be empty.
  std::optional<double> minimum, maximum;  ///< kind number: what can be true, in `unit`.
  std::vector<Option> options;             ///< kind choice, at least two.
  int num_steps = 10;                      ///< kind scale.
  Text low_label, high_label;  ///< kind scale: what stands at step 1 and at the last step.
  /// kind scale: which end is the favourable one; absent where neither is.
  std::optional<bool> high_is_good{};
  bool required = true;
};

/// In which order the stimuli of a block come. Each repetition shows every one of them once.
struct StimulusOrder {
  enum class Method {
    kShuffled,  ///< Each repetition by itself in random order.
    kMixed,     ///< All repetitions together in random order.
    kLatin,     ///< Rows of a cyclic Latin square, over participants and repetitions.
    kWilliams,  ///< Rows of a Williams square, over participants and repetitions.
  };
  Method method = Method::kShuffled;
  std::optional<int> max_in_a_row;  ///< Trials of one stimulus, >= 1. Not of squares.
  int min_distance = 1;  ///< From a stimulus to its next trial, >= 1. Of `kShuffled` alone.
  std::vector<double> not_first;  ///< Stimuli that do not open the block. Not of squares.
  std::size_t row = 0;            ///< Of the square, for the first repetition; see `block_of`.
};

/// One procedure over one varied quantity: the part of a study that gives data.
struct Block {
  std::string
      procedure;       ///< "magnitude_estimation", "magnitude_production", "constant_stimuli".
  std::string medium;  ///< One of `media()` but free space.
  std::string quantity;   ///< "scale", "viscosity_pa_s" or "stiffness_n_per_m".
  MediumDetails details;  ///< Of its medium.
  Text instruction;
  Text question;             ///< What the participant is asked in every trial.
  Text yes_label, no_label;  ///< What the two answers are called; may be empty.
  Text first_label, second_label, third_label;  ///< What intervals are called; may be empty.
  Text low_label, high_label;       ///< Rating: what stands at the ends of the scale.
  std::vector<double> intensities;  ///< Test stimuli, or starting values of an adjustment.
  std::optional<double> reference_intensity;  ///< Constant stimuli.
  std::string standard_medium;    ///< Of what is felt as the standard; "" where there is none.
  std::vector<double> standards;  ///< In the unit of `standard_medium`, each > 0.
  std::vector<double> target_percent;  ///< Production: one repetition a target.
  int repetitions = 1;                 ///< Each shows every intensity once; 1 in production.
  StimulusOrder order;
  double coarse_step = 0.0;              ///< Adjustment, unit of the quantity, > fine_step.
  double fine_step = 0.0;                ///< Adjustment, > 0.
  std::optional<double> max_intensity;   ///< Adjustment: no step goes beyond; none by default.
  double free_space_between_s = 0.0;     ///< Free space before each trial, >= 0.
  double expected_trial_s = 0.0;         ///< For planning the length of a session, > 0.
  double min_stimulus_s = 0.0;           ///< Nobody answers or goes on before, >= 0.
  std::optional<double> max_stimulus_s;  ///< A stimulus ends by itself, >= `min_stimulus_s`.
  std::optional<double> answer_deadline_s;  ///< An answer that comes later is missed, > 0.
  std::optional<int> max_returns;           ///< To stimuli that were felt, in a trial, >= 0.
  bool feedback = false;                    ///< Right or wrong is told after each answer.
  bool cannot_tell = false;                 ///< "Cannot tell" is an answer, too.
  std::optional<Practice> practice;         ///< The block is practice, and no data.
  Levels levels;                            ///< Of the study's factors; may be empty.
  bool participant_answers = false;         ///< By a control of theirs, not by telling.
  /// Asked after the answer to every trial, in this order, before the next one may begin.
  std::vector<QuestionnaireItem> questions;
  std::optional<MaskingNoise> masking_noise{};  ///< In place of the study's; see `sound_of`.
  std::optional<std::vector<Cue>> cues{};       ///< Likewise.
  Settings settings;                            ///< The procedure's own keys, all of them.

  /// A surface that is pressed, not a fluid that is stroked through.
  [[nodiscard]] bool is_pressed() const;
  /// What an interval holds is such a surface: "reference" of a block with a solid standard.
  [[nodiscard]] bool is_pressed_in(std::string_view interval) const;
};

struct Break {
  Text instruction;
  double duration_s = 0.0;  ///< Least rest, >= 0.
};

struct PostExperimentItem {
  std::string name;
  MediumSetting setting;
  Text instruction;
  Text question;
  std::string answer;  ///< "yes_no", "text" or "words".
  int num_words = 0;   ///< How many words "words" asks for.
};

struct PostExperiment {
  std::vector<PostExperimentItem> items;
};

struct Questionnaire {
  Text instruction;
  std::vector<QuestionnaireItem> items;
};

struct Stage;

/// Alternatives between participants. `order` and `latin`: every arm is run, the order of the
/// arms is a cell. `one_of`: each participant gets one arm.
struct Counterbalance {
  struct Arm {
    std::string name;
    std::vector<Stage> stages;
  };
  enum class Method { kOrder, kLatin, kOneOf };
  Method method = Method::kOrder;
  std::vector<Arm> arms;
  std::vector<Stage> between;  ///< Run between two arms of an order, for example a break.
  std::string stratify_by;     ///< Field within whose values it is balanced; "": over all.
};

/// How the blocks of a group take turns, trial by trial.
enum class Turns {
  kRounds,  ///< In a round each block that has trials left comes once, in drawn order.
  kRandom,  ///< Each trial is drawn from all that are left, whatever their block.
};

/// A group of blocks whose trials are mixed, as each of its blocks knows it.
struct Interleaving {
  std::string name;  ///< Of the group; unique in the study, unlike that of any stage.
  Text title;        ///< May be empty.
  Turns turns = Turns::kRounds;

  friend bool operator==(const Interleaving&, const Interleaving&) = default;
};

struct Stage {
  std::string name;  ///< Unique in the study; [a-z0-9_]+.
  Text title;        ///< May be empty.
  /// Runs only for participants of these arms: name of a `one_of` counterbalance to name of its
  /// arm. Empty: runs for everyone.
  std::map<std::string, std::string> only_for;
  std::variant<Checklist, Consent, Explore, Training, Block, Break, PostExperiment,
               Questionnaire, Counterbalance>
      content;
  int line = 0;  ///< Where it stands in the file, for messages.
  /// Of a block whose trials are mixed with those of others. The blocks of a group stand one
  /// after the other in every list of stages.
  std::optional<Interleaving> interleaving{};
};

enum class Blinding { kNone, kParticipant, kDouble };

/// What a study asks of the apparatus.
struct DeviceNeeds {
  int min_contact_points = 5;
  double rate_hz = 1000.0;
  double ramp_s = 0.050;
  double max_missed_ratio = 0.01;       ///< Of a presentation's ticks, [0, 1].
  core::Immersion immersion;            ///< Infinite surface unless the study says otherwise.
  double wall_stiffness_n_per_m = 0.0;  ///< Where the immersion ends; 0 is no wall.
  double wall_friction_ratio = 0.0;     ///< >= 0.
  std::vector<core::ForceMap::Row> force_map;  ///< Empty: none, the thesis's fit.
};

/// What is known of a participant before the session, for counterbalances to be stratified by.
struct ParticipantField {
  std::string name;
  Text question;
  std::vector<Option> options;
};

/// What can be asked of a participant in one session.
struct SessionLimits {
  std::optional<double> max_duration_s;         ///< > 0.
  std::optional<int> max_trials_without_break;  ///< >= 1.
  std::optional<double> max_force_time_n_s;     ///< > 0; see `core::Exposure`.
  std::optional<double> max_under_force_s;      ///< > 0; see `core::Exposure`.

  [[nodiscard]] bool limits_exposure() const noexcept {
    return max_force_time_n_s || max_under_force_s;
  }
};

/// A study file, checked and with every default filled in.
struct Study {
  int format = 1;
  std::string name;                    ///< [a-z0-9_]+
  std::vector<std::string> languages;  ///< Every text has exactly these; the first is shown.
  Text title;
  Text description;  ///< May be empty.
  std::vector<std::string> authors;
  std::string citation;  ///< Of the study it follows; may be empty.
  DeviceNeeds device;
  Blinding blinding = Blinding::kNone;
  SessionLimits session_limits;
  Sound sound;  ///< Heard in all of it but where a block says otherwise; see `sound_of`.
  core::MarkerCodes markers;  ///< Of the pulses that tell another recorder of a session.
  std::vector<ParticipantField> participant_fields;
  std::vector<DesignFactor> factors;
  std::vector<PlannedContrast> contrasts;
  std::optional<SequentialPlan> sequential;  ///< None: all take part before anybody looks.
  std::vector<Stage> stages;
  std::string text;  ///< The file word for word; its SHA-256 identifies the study.
};

}  // namespace jnd::experiments
