#include "analysis/export/study_tables.h"

namespace jnd::analysis {

using enum ColumnType;

const std::vector<CsvColumn>& session_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study", kCount},
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus", kCount},
      {"cells", "", "Counterbalancing: which arms in which order"},
      {"seed", "", "Of everything drawn in the session; 64 bits, so read it as text"},
      {"pilot", "", "1: a pilot, not for analysis", kCount},
      {"completed", "", "1: every stage was run", kCount},
      {"device", "", "Name of the device"},
      {"rate_hz", "Hz", "Rate of the haptic loop and of the recording", kReal},
      {"realtime", "", "What the loop was given by the system"},
      {"recorded", "", "1: samples are kept", kCount},
      {"program_version", "", "Of the jnd that ran the session"},
      {"protocol_sha256", "", "Identifies the study file"},
      {"language", "", "Of the texts that the participant got; empty where nobody read them"},
      {"fields", "",
       "What was known of the participant before, as in sex=female;hand=left; empty where "
       "nothing was asked"},
      {"started_time_ns", "ns", "Since 1970-01-01 UTC; a simulated session counts from 0",
       kCount},
      {"laboratory", "", "Who and what was simulated, as JSON; empty with a person"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& participant_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus", kCount},
      {"num_sessions", "", "Visits in this data set", kCount},
      {"num_completed_sessions", "", "Of them, those in which every stage was run", kCount},
      {"num_trials", "", "Trials whose answer stands, those set aside among them", kCount},
      {"num_excluded_trials", "", "Of them, those set aside with a reason", kCount},
  };
  return kColumns;
}

const std::vector<CsvColumn>& trial_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study", kCount},
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus", kCount},
      {"trial", "", "Running number in the session, from 1", kCount},
      {"attempt", "", "1, or more if the trial was repeated", kCount},
      {"block", "", "Name of the block in the study file"},
      {"procedure", "", "How the block asks"},
      {"medium", "", "What was rendered"},
      {"quantity", "",
       "What intensities mean: scale (ratio), viscosity_pa_s (Pa s) or stiffness_n_per_m "
       "(N/m)"},
      {"repetition", "", "From 1; in each, every stimulus once", kCount},
      {"position", "", "Within the repetition, from 1", kCount},
      {"series", "", "Staircase or series of the block, from 1; empty where there is one",
       kReal},
      {"test_interval", "",
       "Where the order is drawn: interval of the test stimulus, 1 or 2. The interval that was "
       "chosen in a two-interval task is test_interval where response is 1, else "
       "3 - test_interval",
       kReal},
      {"is_catch", "",
       "1: a catch trial, in which nothing is there or the test equals the reference", kCount},
      {"is_practice", "", "1: of a practice block, not for analysis", kCount},
      {"intensity", "unit of quantity", "Test stimulus; of an adjustment the value set", kReal},
      {"reference_intensity", "unit of quantity",
       "Reference stimulus; of a block with a standard_medium in the unit of that medium's "
       "quantity",
       kReal},
      {"standard_medium", "", "What the reference stimulus is; empty: the medium"},
      {"starting_intensity", "unit of quantity",
       "Production and matching: where the adjustment began", kReal},
      {"target_percent", "%", "Production: what it should feel like, water being 100", kReal},
      {"response", "",
       "Percent, or a number in another modulus; 1: yes, different, or the interval of the "
       "test, 0: otherwise; of an adjustment the value set",
       kReal},
      {"response_time_s", "s",
       "From the start of the last stimulus to the answer; where one is adjusted, from the "
       "start "
       "of that",
       kReal},
      {"num_presentations", "", "Stimuli felt in this attempt", kCount},
      {"num_steps", "", "Production and matching: steps of adjustment", kCount},
      {"first_tick", "tick", "First sample of the trial in the recording", kCount},
      {"last_tick", "tick", "Last sample of the trial in the recording", kCount},
      {"excluded", "", "1: set aside; the event trial_excluded has the reason", kCount},
  };
  return kColumns;
}

const std::vector<CsvColumn>& presentation_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study", kCount},
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus", kCount},
      {"trial", "", "Running number in the session", kCount},
      {"attempt", "", "Attempt whose answer stands", kCount},
      {"presentation", "", "Within the attempt, from 1", kCount},
      {"interval", "", "test, reference or free_space"},
      {"intensity", "unit of quantity", "What was presented", kReal},
      {"first_tick", "tick", "First sample in the recording", kCount},
      {"last_tick", "tick", "Last sample in the recording", kCount},
      {"num_strokes", "", "Whole strokes: to a turning point and back", kCount},
      {"stroke_width_m", "m", "Mean distance between turning points", kReal},
      {"max_speed_m_per_s", "m/s", "Mean of the highest speed in each stroke", kReal},
      {"mean_height_m", "m", "Mean height of the hand, workspace frame", kReal},
      {"delivered_damping_n_s_per_m", "N s/m", "Delivered force over speed, regression slope",
       kReal},
      {"commanded_damping_n_s_per_m", "N s/m", "Commanded; empty for water", kReal},
      {"limited_ticks", "ticks", "Ticks in which the force limiter changed the force", kCount},
      {"missed_ticks", "ticks", "Ticks that were due and never ran", kCount},
      {"finger_lag_s", "s", "By which thumb, index and middle trail behind the palm", kReal},
      {"excluded", "", "1: its trial is set aside", kCount},
  };
  return kColumns;
}

const std::vector<CsvColumn>& event_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study", kCount},
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus", kCount},
      {"sequence", "", "1, 2, 3 ... in the order in which it happened", kCount},
      {"kind", "", "What happened"},
      {"version", "", "Of the layout of data", kCount},
      {"time_ns", "ns", "Since 1970-01-01 UTC; a simulated session counts from 0", kCount},
      {"stage", "", "Place of the stage in the participant's list, from 0", kReal},
      {"trial", "", "Running number in the session", kReal},
      {"attempt", "", "1 is the first", kReal},
      {"first_tick", "tick", "In the recording", kReal},
      {"last_tick", "tick", "In the recording", kReal},
      {"intensity", "unit of quantity", "Presented or set", kReal},
      {"supersedes", "", "Sequence of the event that no longer counts", kReal},
      {"data", "", "Everything else, as JSON"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& answer_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study", kCount},
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus", kCount},
      {"stage", "", "Name of the stage in the study file"},
      {"item", "", "Name of the question or point of a checklist"},
      {"answer", "", "As it was given; the last one if corrected"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& questionnaire_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study", kCount},
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus", kCount},
      {"stage", "", "Name of the questionnaire in the study file"},
      {"item", "", "Name of the question in the study file"},
      {"kind", "",
       "How it is answered: number, text, choice, yes_no, yes_no_which, scale, words"},
      {"question", "", "As it was asked, in English where the study has it"},
      {"unit", "", "Of a number"},
      {"num_steps", "", "Of a scale, which begins at 1", kReal},
      {"answer", "", "As it was given, the last one if corrected; empty: none"},
  };
  return kColumns;
}

const std::vector<CsvColumn>& gap_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"session", "", "Number of the session in the study", kCount},
      {"participant", "", "Pseudonym"},
      {"simulated", "", "1: SIMULATED participant and apparatus", kCount},
      {"first_tick", "tick", "First tick without a sample", kCount},
      {"last_tick", "tick", "Last tick without a sample; nothing is filled in", kCount},
      {"missed_ticks", "ticks",
       "Those that never ran, for the loop was held up; others are lost", kCount},
  };
  return kColumns;
}

const std::vector<CsvColumn>& codebook_columns() {
  static const std::vector<CsvColumn> kColumns = {
      {"file", "", "Table that has the column"},
      {"column", "", "Name of the column"},
      {"unit", "", "Of its numbers; empty: none"},
      {"meaning", "", "What it says"},
  };
  return kColumns;
}

}  // namespace jnd::analysis
