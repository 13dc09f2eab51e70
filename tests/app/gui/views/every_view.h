#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "analysis/hand_made_study.h"
#include "app/answering_study.h"
#include "app/asked_study.h"
#include "app/commissioning/daily_check.h"
#include "app/gui/headless_ui.h"
#include "app/gui/views/apparatus_view.h"
#include "app/gui/views/bench_view.h"
#include "app/gui/views/controls_dialog.h"
#include "app/gui/views/data_view.h"
#include "app/gui/views/keys_dialog.h"
#include "app/gui/views/overview_view.h"
#include "app/gui/views/participant_view.h"
#include "app/gui/views/prepare_view.h"
#include "app/gui/views/record_view.h"
#include "app/gui/views/results_parts.h"
#include "app/gui/views/results_view.h"
#include "app/gui/views/run_view_fixture.h"
#include "app/gui/views/sessions_view.h"
#include "app/gui/views/start_view.h"
#include "app/gui/views/study_view.h"
#include "app/language/words.h"
#include "app/operator/device_look.h"
#include "app/operator/operated_session_fixture.h"
#include "app/operator/simulated_study.h"
#include "app/task_study.h"
#include "support/places.h"

// Draws every view of the window in the states that people see, over models as the program
// makes them. A test that looks at all of them need not know any.

namespace jnd::app::gui {

/// Draws one view after another, each until it no longer changes, and calls a function for
/// each.
class EveryView {
 public:
  /// For example, `name` is "data, page 2".
  using Look = std::function<void(const std::string& name, const Drawn& drawn)>;

  EveryView(HeadlessUi& ui, Look look) : ui_(ui), look_(std::move(look)) {}

  void start() {
    StartModel model{.machine = lines(), .shipped = shipped_study_cards(), .version = "0.1.0"};
    const StudyFolder study = open_study_folder(folder());
    model.studies = {{study.folder, study, study.title, study.summary()},
                     {"/data/draft.json", std::nullopt, "Draft",
                      trn("draft · {} problem in the study file",
                          "draft · {} problems in the study file", 2)}};
    using Dialog = StartViewState::Dialog;
    for (const Dialog dialog : {Dialog::kNone, Dialog::kNew, Dialog::kOpen, Dialog::kBrowse}) {
      StartViewState state{.dialog = dialog, .dialog_is_new = true};
      show("start", static_cast<int>(dialog), [&](Ui& ui) {
        (void)draw_start_view(ui, model, entries(FolderEntry::Kind::kStudyFolder), state);
      });
    }
    StartViewState state;
    const StartModel nothing{.shipped = shipped_study_cards(), .version = "0.1.0"};
    show("start, empty", 0, [&](Ui& ui) {
      (void)draw_start_view(ui, nothing, entries(FolderEntry::Kind::kFolder), state);
    });
  }

  void study() {
    const StudyFolder open = open_study_folder(folder());
    for (const std::string& name : shipped_names()) {
      const experiments::Study study = experiments::read_study(protocol(name));
      const StudyOutline outline = outline_of(study);
      const std::vector<PlannedOrder> orders = planned_orders(study, {.num_participants = 3});
      StudyViewState state{.num_participants = 3};
      show("study " + name, 0, [&](Ui& ui) {
        (void)draw_study_view(ui, {.study = &open, .outline = outline, .orders = orders},
                              state);
      });
    }
    const StudyOutline wrong{.file = "/data/wrong.json",
                             .problems = {{"wrong.json", 15, 35, "/stages/3", "found -1"}}};
    StudyViewState state;
    show("study with problems", 0,
         [&](Ui& ui) { (void)draw_study_view(ui, {.outline = wrong, .orders = {}}, state); });
  }

  void overview() {
    WorkControl control;
    const StudyFolder study = open_study_folder(folder());
    const StudyOverview overview = study_overview(folder(), 7, control);
    const auto show_overview = [&](int number, const OverviewModel& model,
                                   OverviewState::Dialog dialog) {
      OverviewState state{.dialog = dialog, .dialog_is_new = true};
      show("overview", number, [&](Ui& ui) { (void)draw_overview(ui, model, state); });
    };
    using Dialog = OverviewState::Dialog;
    const OverviewModel model{
        .study = study, .overview = &overview, .proposed_date = "2026-12-01"};
    for (const Dialog dialog : {Dialog::kNone, Dialog::kPlan, Dialog::kAppointment}) {
      show_overview(static_cast<int>(dialog), model, dialog);
    }
    show_overview(4, {.study = study, .progress = 0.3}, Dialog::kNone);
  }

  void record() {
    const StudyFolder study = open_study_folder(folder());
    for (const std::int64_t session : {1, 3}) {
      const SessionRecord record = session_record(folder(), session);
      const RecordViewModel model{.study = study, .record = &record};
      for (int page = 0; page < 4; ++page) {
        RecordViewState state{.page = static_cast<RecordPage>(page)};
        if (page == 1) state.answer = 0;
        show("record of session " + std::to_string(session) + ", page", page,
             [&](Ui& ui) { (void)draw_record_view(ui, model, state); });
      }
      for (int dialog = 1; dialog < 4; ++dialog) {
        RecordViewState state{.page = RecordPage::kAnswers,
                              .answer = 0,
                              .dialog = static_cast<RecordViewState::Dialog>(dialog),
                              .dialog_is_new = true};
        show("record of session " + std::to_string(session) + ", dialog", dialog,
             [&](Ui& ui) { (void)draw_record_view(ui, model, state); });
      }
    }
  }

  void controls() {
    core::ControlMap map;
    map.set("yes", {"0c45:7403 FootSwitch", "KEY_A"});
    const std::vector<core::ControlReader::DeviceState> devices = {
        {.device = "0c45:7403 FootSwitch", .is_mapped = true, .is_ours = true},
        {.device = "045e:0750 Keyboard", .is_keyboard = true}};
    ControlsState idle{.is_open = true}, waits{.is_open = true, .waits = true};
    ControlsState asks{.is_open = true,
                       .asks_about = core::Control{"045e:0750 Keyboard", "KEY_A"}};
    int number = 0;
    for (ControlsState* state : {&idle, &waits, &asks}) {
      show("controls", number++,
           [&](Ui& ui) { (void)draw_controls_dialog(ui, map, devices, std::nullopt, *state); });
    }
  }

  void sessions() {
    StudyFolder study = open_study_folder(folder());
    const StudyWork idle, works{.running = tr("Backing up"), .progress = 0.4};
    StudyWork done;
    done.outcome = {.sentence = tr("backup in {}", std::string("/data/copy"))};
    int number = 0;
    for (const StudyWork& work : {idle, works, done}) {
      SessionsViewState state;
      show("sessions", number++,
           [&](Ui& ui) { (void)draw_sessions_view(ui, study, work, state); });
    }
    SessionsViewState asks{.asks_for_backup = true, .dialog_is_new = true};
    show("sessions, backup", 0, [&](Ui& ui) { (void)draw_sessions_view(ui, study, {}, asks); });
    study.is_backup = true;
    SessionsViewState state;
    show("sessions of a backup", 0,
         [&](Ui& ui) { (void)draw_sessions_view(ui, study, {}, state); });
    StudyFolder empty{.folder = "/data/new.study", .name = "new", .title = "New"};
    show("sessions, none", 0, [&](Ui& ui) { (void)draw_sessions_view(ui, empty, {}, state); });
  }

  void results() {
    const ResultsModel results = some_results();
    const StudyFolder study = open_study_folder(folder());
    ResultsViewModel model{.study = study, .results = &results};
    for (std::size_t page = 0; page < pages_of(results).size(); ++page) {
      for (const std::size_t participant : {0U, 1U}) {
        ResultsViewState state{.is_new = false, .participant = participant, .page = page};
        show("results, participant " + std::to_string(participant), static_cast<int>(page),
             [&](Ui& ui) { (void)draw_results_view(ui, model, state); });
      }
    }
    ResultsViewState exports{.asks_for_format = true, .dialog_is_new = true};
    show("results, export", 0, [&](Ui& ui) { (void)draw_results_view(ui, model, exports); });
    model.results = nullptr;
    ResultsViewState state;
    show("results, computed", 0, [&](Ui& ui) { (void)draw_results_view(ui, model, state); });
    model.problem = "the study is double-blind";
    model.is_blinded = true;
    show("results, blinded", 0, [&](Ui& ui) { (void)draw_results_view(ui, model, state); });
    ResultsViewState unblinds{.asks_to_unblind = true, .dialog_is_new = true};
    show("results, unblind", 0, [&](Ui& ui) { (void)draw_results_view(ui, model, unblinds); });
  }

  void data() {
    OpenData data;
    DataViewState first;
    const auto draw = [&](DataViewState& state) {
      return [&](Ui& ui) {
        (void)draw_data_view(ui, data.view(), entries(FolderEntry::Kind::kTable), state);
      };
    };
    show("data, none", 0, draw(first));
    data.open(write_file(temporary_.path() / "order.csv",
                         "condition,delay,yes,n\nlight,-90,2,40\nlight,-30,12,40\n"
                         "light,0,20,40\nlight,30,30,40\nlight,90,38,40\nsound,-90,1,40\n"
                         "sound,-30,5,40\nsound,0,12,40\nsound,30,22,40\nsound,90,37,40\n"));
    data.wait();
    data.compare();
    data.wait();
    using Page = DataViewState::Page;
    for (const Page page : {Page::kTable, Page::kCurves, Page::kComparison, Page::kCommand}) {
      DataViewState state{.page = page};
      show("data, page", static_cast<int>(page), draw(state));
    }
    using Dialog = DataViewState::Dialog;
    for (int dialog = 1; dialog <= static_cast<int>(Dialog::kTable); ++dialog) {
      DataViewState state{
          .dialog = static_cast<Dialog>(dialog), .dialog_is_new = true, .column = "condition"};
      show("data, dialog", dialog, draw(state));
    }
    data.open(write_file(temporary_.path() / "wrong.csv", "a,b\n1,2,3\n"));
    data.wait();
    DataViewState state;
    show("data, unreadable", 0, draw(state));
  }

  void device() {
    DeviceView device = look_at_device("lumped", "", {});
    const std::vector<BenchModel::Choice> choices = {{"lumped", "a hand", true},
                                                     {"mouse", "a hand", true}};
    const auto show_page = [&](const std::string& name, int page) {
      BenchViewState state{.page = static_cast<BenchViewState::Page>(page)};
      show(name, page, [&](Ui& ui) {
        (void)draw_bench_view(ui, {.device = device, .choices = choices, .has_study = true},
                              state);
      });
    };
    for (int page = 0; page < 4; ++page) show_page("device, page", page);
    for (int dialog = 1; dialog < 3; ++dialog) {
      BenchViewState state{.page = BenchViewState::Page::kForce,
                           .dialog = static_cast<BenchViewState::Dialog>(dialog)};
      show("device, dialog", dialog, [&](Ui& ui) {
        (void)draw_bench_view(ui, {.device = device, .choices = choices}, state);
      });
    }
    device.is_simulated = false;
    device.profile.remedy = tr("choose another device");
    device.outcome = tr("Stopped. What was measured before is kept.");
    device.live = {{tr("Enabling switch"), tr("open: no force")},
                   {tr("Force that its sensors measure"), "0.1, 0.2, 0.3 N"}};
    device.stop_is_pressed = true;
    for (int page = 0; page < 4; ++page) show_page("device, stopped", page);
    device.stop_is_pressed = false;
    device.work = DeviceWork::kMeasuring;
    device.now = tr("The device is homed, and its tool rests where it did before.");
    using Act = DeviceQuestion::Act;
    const std::vector<std::pair<Act, std::string>> questions = {
        {Act::kTakeHandOut, tr("Take every hand out of the device.")},
        {Act::kHome,
         tr("Home the device as its maker says, by its maker's program if that takes one: "
            "nothing here holds the device meanwhile. Then rest its tool where it rested "
            "before.")},
        {Act::kHold, tr("Hold the tool where it is, or let it rest on something.")},
        {Act::kHold, tr("Go on holding the tool where it is, fingers clear of its links: the "
                        "device will hold it, too, by a force that grows from nothing within "
                        "half a second.")},
        {Act::kTouch, tr("Bring the first contact point to the mark at x {:.0f}, y {:.0f}, z "
                         "{:.0f} mm, and hold it there.",
                         -100.0, 100.0, -250.0)},
        {Act::kLetGo, tr("The device has no force now: take the support away, let go of the "
                         "tool for a moment, and be ready to catch it.")},
        {Act::kHang, tr("Hang {:.0f} g from the tool.", 200.0)},
        {Act::kTakeLoadOff, tr("Take the load off the tool.")}};
    for (const auto& [act, words] : questions) {
      device.question = DeviceQuestion{.act = act, .words = words, .load_kg = 0.2};
      show_page("device, question " + std::to_string(static_cast<int>(act)), 0);
    }
  }

  void preparation() {
    const StudyFolder study = open_study_folder(folder());
    const experiments::Study shipped = experiments::read_study(protocol("viscosity_priming"));
    PrepareModel model{
        .study = study,
        .devices = {{"lumped", "a hand", true}, {"mouse", "a hand", true}},
        .languages = {"en", "de"},
        .fields = shipped.participant_fields,
        .taken = {"P01", "P02"},
        .assigned = "low, then high",
        .seed = 4711,
        .sound = {.is_wanted = true, .outputs = {{"default", "Headphones", false}}},
        .lines = lines()};
    int number = 0;
    for (const char* participant : {"P04", "", "P01"}) {
      PrepareViewState state{.participant = participant, .device = "lumped", .language = "en"};
      show("preparation", number++, [&](Ui& ui) { (void)draw_prepare_view(ui, model, state); });
      model.looking = true;
      model.progress = 0.3;
    }
    PrepareViewState state{
        .participant = "P04", .device = "lumped", .language = "en", .fitting = "glove M"};
    show("preparation, wrong fitting", 0,
         [&](Ui& ui) { (void)draw_prepare_view(ui, model, state); });
  }

  /// The surroundings of a session, and the questions in it.
  void session_dialogs() {
    SessionView view = comparison();
    view.hides_levels = true;
    view.pilot = view.simulated = true;
    view.answers[0].hint = tr("no stroke in the test");
    view.notes = {"a note"};
    using Dialog = RunViewState::Dialog;
    for (int dialog = 0; dialog <= static_cast<int>(Dialog::kGoOnWithout); ++dialog) {
      RunViewState state{.dialog = static_cast<Dialog>(dialog), .dialog_is_new = true};
      state.correct = {.line = view.answers[0]};
      view.step = state.dialog == Dialog::kWhyPaused ? Step::kPaused : Step::kPresenting;
      show_session("session, dialog", dialog, view, state);
    }
    RunViewState state;
    const std::vector<std::pair<Step, std::string>> steps = {{Step::kPaused, tr("Paused")},
                                                             {Step::kFault, tr("No force")},
                                                             {Step::kFailed, tr("Stopped")},
                                                             {Step::kFinished, tr("Finished")}};
    view.loose_points = "the index finger";
    view.loose_bits = 2;
    view.fault = "the emergency stop was pressed";
    view.stop_pressed = true;
    for (const auto& [step, heading] : steps) {
      view.step = step;
      view.heading = heading;
      show_session("session, step", static_cast<int>(step), view, state);
    }
    view.stop_pressed = false;
    view.step = Step::kFault;
    show_session("session, to be armed", 0, view, state);
    view = comparison();
    view.doubt = DoubtView{.trial = 23,
                           .sentence = tr("The answer is {}: {}.", std::string("99999 %"),
                                          tr("more than {:.0f} %", 1000.0))};
    show_session("session, doubt", 0, view, state);
    for (const bool hides : {false, true}) {
      view = comparison();
      view.hides_levels = hides;
      RunViewState run{.shows_apparatus = true};
      ApparatusViewState apparatus;
      show("apparatus", hides ? 1 : 0,
           [&](Ui& ui) { (void)draw_apparatus_view(ui, view, {}, run, apparatus); });
    }
    RunViewState runs;
    show("keys", 0, [&](Ui& ui) {
      (void)draw_run_view(ui, comparison(), {}, after_, runs);
      (void)draw_keys_dialog(ui, ui.drawn().widgets);
    });
  }

  /// Shows a session as its person at the window sees it now, and the participant's own window.
  void session(const std::string& name, const SessionView& view) {
    RunViewState state;
    show_session(name, static_cast<int>(view.step), view, state);
    ParticipantViewState read;
    show(name + ", participant", 0,
         [&](Ui& ui) { draw_participant_view(ui, participant_screen(view, ""), read); });
  }

  static std::vector<std::string> shipped_names() {
    std::vector<std::string> names;
    for (const auto& entry :
         std::filesystem::directory_iterator(test_support::source_folder() / "protocols")) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".json") && !name.ends_with(".schema.json")) {
        names.push_back(entry.path().stem().string());
      }
    }
    std::ranges::sort(names);
    return names;
  }

 private:
  using Draw = std::function<void(Ui&)>;

  /// The heights of scrolled content are known a frame later, and a dialog takes one frame to
  /// open.
  void show(const std::string& name, int number, const Draw& draw) {
    for (int i = 0; i < 4; ++i) ui_.frame(draw);
    look_(name + (number > 0 ? " " + std::to_string(number) : ""), ui_.drawn());
    ui_.frame([](Ui&) {});
  }
  void show_session(const std::string& name, int number, const SessionView& view,
                    RunViewState& state) {
    show(name, number, [&](Ui& ui) { (void)draw_run_view(ui, view, {}, after_, state); });
  }

  static std::filesystem::path protocol(const std::string& name) {
    return test_support::source_folder() / "protocols" / (name + ".json");
  }
  static EntriesOf entries(FolderEntry::Kind kind) {
    return [kind](const std::filesystem::path& folder) {
      return std::vector<FolderEntry>{{folder / "honey", kind}};
    };
  }
  /// Makes two people who are done, and one whose session was interrupted.
  std::filesystem::path folder() {
    if (simulated_ == nullptr) {
      simulated_ = std::make_unique<SimulatedStudy>();
      simulated_->simulate(2);
      (void)simulated_->interrupt(3, /*pilot=*/true);
    }
    return simulated_->folder();
  }
  static ResultsModel some_results() {
    analysis::HandMadeStudy study(kTinyStudy);
    for (const char* name : {"P01", "P02", "P03"}) {
      study.add(name);
      study.compare_ten("comparison", 6 + name[2] - '0');
      for (const double intensity : {1.0, 2.0, 4.0}) study.estimate(intensity, 50 * intensity);
      study.produce(100.0, 2.0);
      study.produce(200.0, 4.0 + name[2] - '0');
    }
    WorkControl control;
    return results_model(study.folder(), control);
  }
  /// Returns checks before a session, good and bad.
  static std::vector<PreflightLine> lines() {
    return {disk_line(80e9, 1000.0, 3600.0),
            disk_line(1e3, 1000.0, 3600.0),
            device_line("lumped", 1000.0, 5),
            device_line("mouse", 1000.0, 5),
            loop_line({.rate_hz = 1000.0, .duration_s = 2.0, .lateness_p99_us = 3.0}),
            loop_line({.rate_hz = 1000.0,
                       .duration_s = 2.0,
                       .lateness_p99_us = 300.0,
                       .missed_ticks = 7})};
  }

  HeadlessUi& ui_;
  Look look_;
  AfterSession after_;
  test_support::TemporaryFolder temporary_;
  std::unique_ptr<SimulatedStudy> simulated_;
};

/// Runs sessions at a simulated hand, with several procedures and most kinds of stages.
class EverySessionTest : public OperatedSessionTest {
 protected:
  /// Calls the function for each state of each session once.
  void for_each_state(const std::function<void(const std::string&, const SessionView&)>& look) {
    for (const std::string& text : {kTinyStudy, kTaskStudy, kAnsweringStudy, kAskedStudy}) {
      folder_ = temporary_.path() / (std::to_string(text.size()) + ".study");
      session_.reset();
      open(text);
      look("session, begin", view());
      act(operate::Begin{});
      std::set<std::string> seen;
      for (int guard = 0; guard < 500 && view().step != Step::kFinished; ++guard) {
        const SessionView now = view();
        if (seen.insert(now.heading + now.sentence).second)
          look("session, " + now.heading, now);
        go_on(now, look, seen);
      }
      EXPECT_EQ(view().step, Step::kFinished) << view().sentence << view().refusal;
      look("session, over", view());
    }
  }

 private:
  using LookAt = std::function<void(const std::string&, const SessionView&)>;
  /// Works like `step_on`, with whatever intervals a trial has.
  void go_on(const SessionView& now, const LookAt& look, std::set<std::string>& seen) {
    if (now.step == Step::kItem) {
      const char* answer = now.item->kind == ItemView::Kind::kScale ? "1" : "1.8";
      act(operate::AnswerItem{now.stage, now.item->name, answer, now.item->trial});
      return;
    }
    const bool in_trial = now.step == Step::kReady || now.step == Step::kPresenting;
    if (!in_trial) return step_on(now);
    const std::int64_t trial = now.trial->trial;
    std::vector<std::string> intervals = {"test"};
    if (now.trial->has_reference) intervals = {"reference", "test"};
    if (now.trial->order_is_drawn) {
      intervals = {"first", "second", "third"};
      intervals.resize(static_cast<std::size_t>(now.trial->num_intervals));
    }
    for (const std::string& interval : intervals) {
      const SessionView felt = act(operate::Present{trial, interval});
      if (seen.insert(felt.heading + felt.sentence).second) {
        look("session, " + felt.heading, felt);
      }
      pass(1.2);
    }
    act(operate::Answer{trial, 1.0});
  }
};

}  // namespace jnd::app::gui
