#include "experiments/session/event.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"

namespace jnd::experiments {
namespace event_test {

/// Returns one event of each kind, with no field at its default.
std::vector<EventData> one_of_each() {
  const PresentationSummary summary{.measures = {.num_strokes = 3,
                                                 .stroke_width_m = 0.26,
                                                 .max_speed_m_per_s = 0.44,
                                                 .mean_height_m = -0.4,
                                                 .delivered_damping_n_s_per_m = 3.2,
                                                 .commanded_damping_n_s_per_m = std::nullopt,
                                                 .limited_ticks = 4,
                                                 .finger_lag_s = 0.012}};
  return {SessionStarted{"de", {{"sex", "female"}}},
          StageEntered{.stage = 2, .num_together = 3},
          ItemAnswered{2, "about_you", "body_height_m", "1.75"},
          MediumExplored{2, "viscous", 16.0, 10, 20},
          StageFinished{2},
          TrialsDrawn{2, 4, {{.repetition = 2, .position = 3, .intensity = 1.5}}},
          TrialStarted{4, 2, 30},
          PresentationStarted{4, 2, 3, "reference", 1.853, 31},
          PresentationEnded{4, 2, 3, 40, summary},
          IntensityAdjusted{4, 2, 1.0, 1.5},
          TrialAnswered{4, 2, 1.0, {2.5}, 41},
          AnswerUndone{4, 2, 17, "why"},
          AnswerCorrected{4, 2, 17, std::nullopt, "why"},
          AttemptDiscarded{4, 2, "why", 7, true},
          TrialExcluded{4, "why"},
          TrialIncluded{4, "why"},
          NoteAdded{"a note with \"quotes\" and \xc3\xbc"},
          Paused{"why"},
          Continued{},
          FaultRaised{"what"},
          SessionResumed{"repeat", 5, 6},
          LoopStarted{"SCHED_FIFO 80",
                      true,
                      {0, 1},
                      7,
                      DeviceTold{.model = "delta",
                                 .serial = "17",
                                 .firmware = "1.2",
                                 .share_ratio = {0.25, 0.75, 0.0, 0.0, 0.0},
                                 .has = {"measured_force"},
                                 .own_mass_kg = 0.25,
                                 .own_damping_n_s_per_m = 2.5,
                                 .closed_loop_delay_s = 0.002}},
          LoopMeasured{
              .num_ticks = 9,
              .missed_ticks = 1,
              .num_dropped_samples = 2,
              .max_lateness_ns = 2000,
              .max_tick_cost_ns = 300,
              .lateness = {{1024, 4}, {2048, 5}},
              .tick_cost = {{512, 9}},
              .device_clock =
                  core::ClockDrift{.drift_ppm = 12.5, .residual_s = 1e-5, .observed_s = 60.0}},
          Unblinded{"why"},
          ArmingChanged{"armed", "by the experimenter"},
          ExposureTold{{.force_time_n_s = 12.5, .under_force_s = 3.25}},
          GuardNoticed{"force_oscillates", 3, 1},
          FittingKept{.fitting = {{"glove", "M"}, {"thumb", "a thin pad"}},
                      .held = {"thumb", "index"},
                      .neutral_pose_m = {{"thumb", {0.0, -0.061, -0.1}},
                                         {"index", {1.0 / 3.0, 0.059, -0.1}}}},
          QuestionAnswered{4, 2, "confidence", "3"},
          TurnTaken{4},
          PauseExplained{17, "why"},
          StreamOpened{.direction = "in",
                       .name = "Amplifier",
                       .type = "EEG",
                       .channel_format = "float32",
                       .source_id = "amp-7",
                       .hostname = "lab",
                       .channel_count = 64,
                       .nominal_rate_hz = 500.0,
                       .file = "0007.stream-01.sqlite",
                       .by = "jnd",
                       .monotonic_s = 1234.5},
          StreamClosed{.direction = "in",
                       .name = "Amplifier",
                       .file = "0007.stream-01.sqlite",
                       .num_samples = 1000,
                       .num_offsets = 3,
                       .num_dropped = 1,
                       .sha256 = "ab"},
          StreamFailed{"in", "type=EEG", "expected a stream, found none"},
          SoundStarted{.output = "ALSA 1.2.8, default",
                       .scheduler = "SCHED_FIFO 20",
                       .rate_hz = 48000.0,
                       .cue_delay_s = 0.025,
                       .full_scale_db_spl = 101.5,
                       .calibrated_on = "2026-11-26",
                       .noise_level_dbfs = -36.5},
          CuesPlayed{{{.moment = "begin",
                       .trial = 4,
                       .attempt = 2,
                       .presentation = 3,
                       .asked_monotonic_s = 12.5,
                       .heard_monotonic_s = 12.525}}},
          SoundMeasured{.num_frames = 48000,
                        .num_underruns = 1,
                        .num_limited = 2,
                        .num_lost_cues = 3,
                        .max_latency_s = 0.025},
          SoundMissing{"expected an output, found none"},
          MarkersOpened{.port = "/dev/ttyUSB0",
                        .way = "bytes",
                        .width_s = 0.005,
                        .codes = {{"answer", 8}, {"end", 0}}},
          MarkersSent{.pulses = {{17, 4, 12345.6789012, 1.0 / 3e5}, {0, 32, 12346.0, 0.0}}},
          MarkersClosed{.port = "/dev/ttyUSB0", .num_sent = 100, .num_dropped = 1},
          MarkersFailed{"/dev/ttyUSB0", "expected a port, found none"},
          SessionCompleted{},
          SessionEndedEarly{"why"}};
}

TEST(Event, EveryKindComesBackFromItsRowAsItWas) {
  const std::vector<EventData> all = one_of_each();
  ASSERT_EQ(all.size(), std::variant_size_v<EventData>);
  for (std::size_t index = 0; index < all.size(); ++index) {
    ASSERT_EQ(all[index].index(), index);
    const core::EventRow row =
        row_from_event(7, {.sequence = 9, .time_ns = 11, .data = all[index]});
    const Event back = event_from_row(row);
    EXPECT_EQ(back.sequence, 9);
    EXPECT_EQ(back.time_ns, 11);
    // The event that was read back must have the same stored form as the original.
    const core::EventRow again = row_from_event(7, back);
    EXPECT_EQ(again.kind, row.kind);
    EXPECT_EQ(again.data, row.data) << row.kind;
    EXPECT_EQ(again.stage, row.stage);
    EXPECT_EQ(again.trial, row.trial);
    EXPECT_EQ(again.attempt, row.attempt);
    EXPECT_EQ(again.first_tick, row.first_tick);
    EXPECT_EQ(again.last_tick, row.last_tick);
    EXPECT_EQ(again.intensity, row.intensity);
    EXPECT_EQ(again.supersedes, row.supersedes);
  }
}

core::PresentationMeasures measures_of(const std::string& data) {
  const core::EventRow row{.session = 1,
                           .sequence = 1,
                           .kind = "presentation_ended",
                           .trial = 1,
                           .attempt = 1,
                           .last_tick = 1,
                           .data = data};
  return std::get<PresentationEnded>(event_from_row(row).data).summary.measures;
}

/// The keys that every event of a presentation has, without those that were added later.
constexpr char kFirstKeys[] =
    R"("presentation":1,"stroke_width_m":0.26,"max_speed_m_per_s":null,"mean_height_m":-0.4,)"
    R"("num_strokes":3,"delivered_damping_n_s_per_m":3.2,"commanded_damping_n_s_per_m":null,)"
    R"("limited_ticks":4)";

TEST(Event, OfAnOlderProgramLacksWhatCameLater) {
  const core::PresentationMeasures measures = measures_of(std::string("{") + kFirstKeys + "}");
  EXPECT_EQ(measures.num_strokes, 3);
  EXPECT_EQ(measures.stroke_width_m, 0.26);
  EXPECT_FALSE(measures.max_speed_m_per_s);
  EXPECT_EQ(measures.limited_ticks, 4);
  EXPECT_EQ(measures.missed_ticks, 0);
  EXPECT_FALSE(measures.finger_lag_s);
  const core::PresentationMeasures later =
      measures_of(std::string("{") + kFirstKeys + R"(,"finger_lag_s":0.5,"missed_ticks":2})");
  EXPECT_EQ(later.finger_lag_s, 0.5);
  EXPECT_EQ(later.missed_ticks, 2);
}

TEST(Event, WithoutWhatEveryEventOfItsKindHasIsDamaged) {
  EXPECT_THROW((void)measures_of(R"({"presentation":1})"), core::Error);
  EXPECT_THROW((void)measures_of(std::string("{") + kFirstKeys + R"(,"missed_ticks":1.5})"),
               core::Error);
  EXPECT_THROW((void)measures_of(std::string("{") + kFirstKeys + R"(,"finger_lag_s":"a"})"),
               core::Error);
}

TEST(Event, StoresWhatWasMeasuredUnderTheNamesOfItsColumns) {
  const auto data_of = [](const core::PresentationMeasures& measures) {
    return row_from_event(1, {.sequence = 1,
                              .data = PresentationEnded{1, 1, 1, 9, {.measures = measures}}})
        .data;
  };
  EXPECT_EQ(data_of({.num_strokes = 2, .stroke_width_m = 0.0}),
            R"({"commanded_damping_n_s_per_m":null,"delivered_damping_n_s_per_m":null,)"
            R"("finger_lag_s":null,"limited_ticks":0,"max_speed_m_per_s":null,)"
            R"("mean_height_m":null,"num_strokes":2,"presentation":1,"stroke_width_m":0.0})");
  EXPECT_NE(data_of({.missed_ticks = 7}).find(R"("missed_ticks":7)"), std::string::npos);
}

TEST(Event, OneOfANewerProgramIsRefusedAndNotGuessedAt) {
  core::EventRow row = row_from_event(3, {.sequence = 9, .data = NoteAdded{"a"}});
  EXPECT_NO_THROW((void)event_from_row(row));
  row.version = 2;
  try {
    (void)event_from_row(row);
    FAIL() << "read";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("session 3, event 9: expected"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("newer jnd"), std::string::npos);
  }
}

TEST(Event, StoresAnAnswerUnderReadableWords) {
  const core::EventRow row =
      row_from_event(1, {.sequence = 1, .data = TrialAnswered{4, 2, 120, {2.5}, 41}});
  EXPECT_EQ(row.kind, "trial_answered");
  EXPECT_EQ(row.trial, 4);
  EXPECT_EQ(row.last_tick, 41);
  EXPECT_EQ(row.data, R"({"response":120.0,"response_time_s":2.5})");
}

std::string refusal(core::EventRow row) {
  try {
    (void)event_from_row(row);
  } catch (const core::Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Event, TakesNoNumberThatItCouldNotHold) {
  core::EventRow row = row_from_event(
      3, {.sequence = 8, .data = PresentationStarted{4, 2, 3, "reference", 1.853, 31}});
  row.data = R"({"presentation": 1e300, "interval": "test"})";
  EXPECT_EQ(
      refusal(row),
      "session 3, event 8: expected the data of presentation_started, found: presentation: "
      "expected a whole number up to 9007199254740992, found 1e+300");
  for (const char* number : {"1.5", "true", "18446744073709551615", "-9223372036854775808"}) {
    row.data = std::string(R"({"interval": "test", "presentation": )") + number + '}';
    EXPECT_NE(refusal(row).find("expected a whole number"), std::string::npos) << number;
  }
  row = row_from_event(3, {.sequence = 8, .data = TrialsDrawn{2, 4, {{.repetition = 2}}}});
  row.data.replace(row.data.find("\"repetition\":2") + 13, 1, "4294967298");
  EXPECT_NE(refusal(row).find("repetition: expected a whole number up to 2147483647"),
            std::string::npos)
      << refusal(row);
  row.data = R"({"trials": {}})";
  EXPECT_NE(refusal(row).find("trials: expected a list, found object"), std::string::npos);
}

TEST(Event, TakesNoColumnThatTheFoldCouldNotCount) {
  core::EventRow row = row_from_event(3, {.sequence = 8, .data = StageFinished{1}});
  row.stage = std::numeric_limits<std::int64_t>::max();
  EXPECT_NE(refusal(row).find("stage: expected a number up to 2^53 in this column"),
            std::string::npos);
  row.stage.reset();
  EXPECT_NE(refusal(row).find("stage: expected a number up to 2^53 in this column, found none"),
            std::string::npos);
  row = row_from_event(3, {.sequence = 8, .data = MediumExplored{2, "viscous", 16.0, 10, 20}});
  row.intensity = std::numeric_limits<double>::infinity();
  EXPECT_NE(
      refusal(row).find("intensity: expected a number up to 2^53 in this column, found inf"),
      std::string::npos);
}

TEST(Event, TellsOfDamagedRowsInAShortSentence) {
  core::EventRow row = row_from_event(3, {.sequence = 8, .data = NoteAdded{"x"}});
  row.data = std::string(1000000, '\xFF');
  EXPECT_LT(refusal(row).size(), 300u);
  EXPECT_NE(refusal(row).find("found `\\xFF\\xFF"), std::string::npos) << refusal(row);
  row.data = std::string("{\"text\":\"x\"}\0junk", 17);
  EXPECT_NE(refusal(row).find("as a JSON object, found"), std::string::npos);
  row.kind = std::string(1000000, '\x1B');
  EXPECT_LT(refusal(row).size(), 300u);
  EXPECT_EQ(refusal(row).find('\x1B'), std::string::npos);
}

TEST(Event, NamesTheEventWhoseDataAreDamaged) {
  core::EventRow row = row_from_event(3, {.sequence = 8, .data = NoteAdded{"x"}});
  for (const char* damage : {"", "{", "[]", "{\"text\":5}", "null"}) {
    row.data = damage;
    try {
      (void)event_from_row(row);
      FAIL() << damage;
    } catch (const core::Error& error) {
      EXPECT_NE(std::string(error.what()).find("session 3, event 8"), std::string::npos);
    }
  }
  row.kind = "teleported";
  EXPECT_THROW((void)event_from_row(row), core::Error);
  core::EventRow without_columns = row_from_event(3, {.sequence = 8, .data = StageEntered{1}});
  without_columns.stage.reset();
  EXPECT_THROW((void)event_from_row(without_columns), core::Error);
}

}  // namespace event_test
}  // namespace jnd::experiments
