#include "experiments/protocol/starter_study.h"

#include <utility>

#include "experiments/protocol/located_json.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::experiments {
namespace {

constexpr const char* kStarter = R"json({
  "$schema": "./study.schema.json",
  "comment": "Every object may have a `comment`. `jnd validate` tells all problems of this file, an editor that reads the schema what every key means, `jnd plan` what the participants would get.",
  "format": 1,
  "name": "@NAME@",
  "languages": ["en"],
  "title": {"en": "A title for people"},
  "description": {"en": "What the study asks, in a sentence."},
  "authors": ["Your name"],
  "device": {
    "comment": "What the study asks of the apparatus: points of the hand that must be held, rate of the loop, time in which one medium turns into the next.",
    "min_contact_points": 5,
    "rate_hz": 1000,
    "ramp_s": 0.05
  },
  "blinding": "participant",
  "stages": [
    {
      "comment": "For the experimenter, to be ticked off. `say` is read out word for word.",
      "kind": "checklist",
      "name": "preparation",
      "items": [
        {"text": {"en": "Test the emergency stop."}},
        {"text": {"en": "Greet the participant."}, "say": {"en": "Thank you for coming."}}
      ]
    },
    {
      "comment": "Write here what happens, what is recorded, what the risks are, and that one may stop at any time.",
      "kind": "consent",
      "name": "consent",
      "paragraphs": [
        {"en": "You will move your hand through virtual fluids for about twenty minutes."},
        {"en": "Your answers and movements are recorded under a number, without your name. You may stop at any time."}
      ],
      "agreement": {"en": "I have read this and take part of my own free will."}
    },
    {
      "comment": "A number's name ends in its unit; minimum and maximum catch centimetres. Other kinds: text, choice, yes_no, yes_no_which, scale.",
      "kind": "questionnaire",
      "name": "about_you",
      "instruction": {"en": "A question before we begin."},
      "items": [
        {
          "name": "body_height_m", "kind": "number", "unit": "m", "minimum": 1, "maximum": 2.5,
          "question": {"en": "How tall are you?"}
        }
      ]
    },
    {
      "comment": "Free exploration: free_space, water (scale), viscous (viscosity_pa_s), solid (stiffness_n_per_m).",
      "kind": "explore",
      "name": "free_space",
      "instruction": {"en": "Move your hand about and get used to the device."},
      "media": [{"medium": "free_space", "duration_s": 60}]
    },
    {
      "comment": "Examples of the range to come; nothing is scored.",
      "kind": "training",
      "name": "examples",
      "instruction": {"en": "Feel these two fluids."},
      "examples": [
        {"medium": "viscous", "viscosity_pa_s": 5, "duration_s": 20},
        {"medium": "viscous", "viscosity_pa_s": 15, "duration_s": 20}
      ]
    },
    {
      "comment": "Everyone runs both arms; half begin with the first. Each new participant gets the cell with the fewest completed sessions.",
      "kind": "counterbalance",
      "name": "task_order",
      "method": "order",
      "arms": [
        {
          "name": "estimation",
          "stages": [
            {
              "comment": "The participant says how strong each stimulus feels. With `modulus` `free` everybody chooses their own numbers; with `water_is_100` or `standard` the instruction has to say what is 100. The other way round is magnitude_production, with target_percent and steps.",
              "kind": "block",
              "name": "estimation",
              "procedure": "magnitude_estimation",
              "medium": "viscous",
              "viscosity_pa_s": [2, 4, 8, 16],
              "modulus": "free",
              "repetitions": 3,
              "instruction": {"en": "Give the first fluid any number above 0 that fits how thick it feels, and every other one a number in proportion: twice the number for one that feels twice as thick."},
              "question": {"en": "Which number fits how thick this feels?"},
              "free_space_between_s": 2,
              "expected_trial_s": 15
            }
          ]
        },
        {
          "name": "comparison",
          "stages": [
            {
              "comment": "The reference first, then a test; yes or no. Some tests below the reference, some above.",
              "kind": "block",
              "name": "comparison",
              "procedure": "constant_stimuli",
              "medium": "viscous",
              "viscosity_pa_s": [5, 6.5, 8.5, 11.5, 15, 20],
              "reference_viscosity_pa_s": 10,
              "repetitions": 5,
              "instruction": {"en": "First comes the reference, then the test."},
              "question": {"en": "Does this feel thicker than the reference?"},
              "free_space_between_s": 2,
              "expected_trial_s": 15
            }
          ]
        }
      ],
      "between": [
        {
          "kind": "break",
          "name": "rest",
          "instruction": {"en": "Take your hand out of the device and rest."},
          "duration_s": 120
        }
      ]
    },
    {
      "kind": "checklist",
      "name": "closing",
      "items": [
        {"text": {"en": "Check that all recorded data are there."}},
        {"text": {"en": "Make a backup (after each day)."}}
      ]
    }
  ]
}
)json";

}  // namespace

std::string starter_study(const std::string& name) {
  std::string text = kStarter;
  const std::string place = "@NAME@";
  return text.replace(text.find(place), place.size(), name);
}

std::string renamed_study(const std::string& text, const std::string& file_name,
                          const std::string& name) {
  std::vector<StudyProblem> problems = study_text_problems(text, file_name);
  if (!problems.empty()) throw ProtocolError(std::move(problems));
  const LocatedJson file(text, file_name, problems);
  const std::size_t begin = file.value_position("/name").byte;
  // A name contains no quotes, whichever way they are escaped.
  const std::size_t end = text.find('"', begin + 1) + 1;
  std::string renamed = text;
  return renamed.replace(begin, end - begin, '"' + name + '"');
}

}  // namespace jnd::experiments
