#include "app/operator/session_worker.h"

#include <chrono>
#include <exception>
#include <utility>

#include "app/language/words.h"
#include "app/operator/operated_session.h"

namespace jnd::app {

namespace {
/// How often the session looks at the loop, and how often a window gets a new picture.
constexpr auto kGlance = std::chrono::milliseconds(15);
constexpr auto kBetweenPictures = std::chrono::milliseconds(33);
}  // namespace

SessionWorker::SessionWorker(Parameters parameters, OperatorExchange& exchange)
    : parameters_(std::move(parameters)),
      exchange_(exchange),
      trace_({.rate_hz = parameters_.study.device.rate_hz}),
      scopes_({.rate_hz = parameters_.study.device.rate_hz}),
      thread_([this] { run(); }) {}

SessionWorker::~SessionWorker() {
  request(operate::Leave{.reason = as_is("the window was closed")});
  thread_.join();
}

void SessionWorker::request(OperatorRequest request) {
  {
    const std::lock_guard guard(mutex_);
    requests_.push_back(std::move(request));
    ++num_requested_;
  }
  requested_.notify_one();
}

std::shared_ptr<const SessionView> SessionWorker::view() const {
  const std::lock_guard guard(mutex_);
  return view_;
}

bool SessionWorker::is_behind() const {
  const std::lock_guard guard(mutex_);
  return num_shown_ < num_requested_;
}

bool SessionWorker::has_waiting_requests() const {
  const std::lock_guard guard(mutex_);
  return requests_wait_;
}

std::string SessionWorker::failure() const {
  const std::lock_guard guard(mutex_);
  return failure_;
}

std::vector<OperatorRequest> SessionWorker::wait_for_requests() {
  std::unique_lock lock(mutex_);
  requested_.wait_for(lock, kGlance, [this] { return !requests_.empty(); });
  num_taken_ = num_requested_;
  return std::exchange(requests_, {});
}

std::vector<OperatorRequest> SessionWorker::taken_requests() {
  const std::lock_guard guard(mutex_);
  num_taken_ = num_requested_;
  return std::exchange(requests_, {});
}

void SessionWorker::publish(const OperatedSession& session) {
  auto picture = std::make_shared<const SessionView>(session.view());
  {
    const std::lock_guard guard(mutex_);
    view_.swap(picture);
    num_shown_ = num_taken_;
    requests_wait_ = session.has_waiting_requests();
  }
  if (parameters_.wake) parameters_.wake();
}

double SessionWorker::simulated_now_s() const {
  return parameters_.simulated_clock_s ? parameters_.simulated_clock_s() : 0.0;
}

void SessionWorker::run() noexcept {
  try {
    work();
  } catch (const std::exception& error) {
    // The session is gone, and so is its device.
    const std::lock_guard guard(mutex_);
    failure_ = error.what();
  }
  parameters_.store.reset();
  over_.store(true, std::memory_order_release);
  if (parameters_.wake) parameters_.wake();
}

void SessionWorker::work() {
  OperatedSession session({.store = *parameters_.store,
                           .session = parameters_.session,
                           .study = parameters_.study,
                           .laboratory = parameters_.laboratory.get(),
                           .exchange = exchange_,
                           .trace = &trace_,
                           .scopes = &scopes_,
                           .language = parameters_.language,
                           .fitting = parameters_.fitting,
                           .realtime = !parameters_.simulated_clock_s,
                           .allow_no_realtime = parameters_.allow_no_realtime,
                           .stops = parameters_.stops,
                           .streams = parameters_.streams,
                           .sound = parameters_.sound,
                           .markers = parameters_.markers,
                           .controls = parameters_.controls});
  auto next_picture = std::chrono::steady_clock::now();
  double last_look_s = simulated_now_s();
  while (!session.over()) {
    const std::vector<OperatorRequest> requests = wait_for_requests();
    for (const OperatorRequest& request : requests) session.request(request);
    const double now_s = simulated_now_s();
    session.advance(now_s - std::exchange(last_look_s, now_s));
    // Results of requests are shown at once; mere movement is shown at the window's pace.
    const auto now = std::chrono::steady_clock::now();
    if (requests.empty() && now < next_picture) continue;
    publish(session);
    next_picture = now + kBetweenPictures;
  }
  // Who wrote something while the session was left.
  for (const OperatorRequest& request : taken_requests()) session.request(request);
  session.keep_what_was_written();
  publish(session);
}

}  // namespace jnd::app
