#include "app/operator/session_worker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>

#include "app/session/session_setup.h"
#include "app/tiny_study.h"
#include "core/storage/integrity.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace session_worker_test {

namespace fs = std::filesystem;

class SessionWorkerTest : public ::testing::Test {
 protected:
  std::unique_ptr<SessionWorker> start(const std::string& study_text = kTinyStudy) {
    experiments::Study study = experiments::read_study_text(study_text, "study.json");
    auto laboratory =
        std::make_unique<experiments::Laboratory>(experiments::thesis_laboratory());
    auto store = std::make_unique<core::StudyStore>(folder_, core::StudyStore::Mode::kCreate);
    const std::int64_t session = add_sessions(*store,
                                              {.study = study,
                                               .laboratory = laboratory.get(),
                                               .study_file = "study.json",
                                               .seed = 7,
                                               .realtime = true},
                                              {"P01"})
                                     .front();
    return std::make_unique<SessionWorker>(
        SessionWorker::Parameters{.store = std::move(store),
                                  .session = session,
                                  .study = std::move(study),
                                  .laboratory = std::move(laboratory),
                                  .allow_no_realtime = true},
        exchange_);
  }

  /// Sends heartbeats, as a window does, until a view fulfils the condition.
  std::shared_ptr<const SessionView> until(
      SessionWorker& worker, const std::function<bool(const SessionView&)>& is_so) {
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < patience) {
      exchange_.heartbeat.beat();
      const auto view = worker.view();
      if (view && is_so(*view)) return view;
      if (worker.over()) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "that picture never came; failure: " << worker.failure();
    return std::make_shared<SessionView>();
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  fs::path folder_ = temporary_.path() / "a.study";
  OperatorExchange exchange_;
};

TEST_F(SessionWorkerTest, CarriesOutRequestsAndShowsWhatCameOfThem) {
  const auto worker = start();
  until(*worker, [](const SessionView& view) { return view.step == Step::kBegin; });
  worker->request(operate::Begin{});
  const auto item =
      until(*worker, [](const SessionView& view) { return view.step == Step::kItem; });
  worker->request(operate::AnswerItem{item->stage, item->item->name, "done"});
  until(*worker, [](const SessionView& view) { return view.stage == 1; });
  EXPECT_GT(worker->view()->telemetry.num_ticks, 0);
  EXPECT_FALSE(worker->trace().snapshot().empty());
}

TEST_F(SessionWorkerTest, IsBehindUntilItsPictureShowsWhatCameOfARequest) {
  const auto worker = start();
  until(*worker, [](const SessionView& view) { return view.step == Step::kBegin; });
  EXPECT_FALSE(worker->is_behind());
  worker->request(operate::Begin{});
  EXPECT_TRUE(worker->is_behind() || worker->view()->step == Step::kItem);
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (worker->is_behind() && std::chrono::steady_clock::now() < patience) {
    exchange_.heartbeat.beat();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_EQ(worker->view()->step, Step::kItem);
  EXPECT_FALSE(worker->has_waiting_requests());
}

TEST_F(SessionWorkerTest, WhoDestroysItLeavesASessionThatCanBeResumed) {
  {
    const auto worker = start();
    worker->request(operate::Begin{});
    until(*worker, [](const SessionView& view) { return view.step == Step::kItem; });
  }
  const core::StudyStore store(folder_, core::StudyStore::Mode::kReadOnly);
  EXPECT_FALSE(store.finished(1));
  EXPECT_EQ(store.events(1).back().kind, "paused");
  EXPECT_TRUE(core::verify(store).problems.empty());
}

TEST_F(SessionWorkerTest, AWindowThatFallsSilentStopsTheForce) {
  const auto worker = start();
  until(*worker, [](const SessionView& view) { return view.step == Step::kBegin; });
  // From here on nobody sends heartbeats.
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (worker->view()->step != Step::kFault && std::chrono::steady_clock::now() < patience) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(worker->view()->fault_name, "heartbeat_lost");
  // Arming needs a heartbeat first. Otherwise the first tick of the armed loop finds the window
  // silent.
  exchange_.heartbeat.beat();
  worker->request(operate::Rearm{});
  until(*worker, [](const SessionView& view) { return view.step == Step::kBegin; });
}

TEST_F(SessionWorkerTest, ADeviceThatDoesNotStartIsToldAndNothingIsStored) {
  experiments::Study study = experiments::read_study_text(kTinyStudy, "study.json");
  auto store = std::make_unique<core::StudyStore>(folder_, core::StudyStore::Mode::kCreate);
  const std::int64_t session = add_sessions(*store,
                                            {.study = study,
                                             .study_file = "study.json",
                                             .device = "unplugged",
                                             .seed = 7,
                                             .realtime = true},
                                            {"P01"})
                                   .front();
  SessionWorker worker({.store = std::move(store),
                        .session = session,
                        .study = std::move(study),
                        .allow_no_realtime = true},
                       exchange_);
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!worker.over() && std::chrono::steady_clock::now() < patience) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_NE(worker.failure().find("unplugged"), std::string::npos) << worker.failure();
  const core::StudyStore read(folder_, core::StudyStore::Mode::kReadOnly);
  EXPECT_TRUE(read.events(session).empty());
}

}  // namespace session_worker_test
}  // namespace jnd::app
