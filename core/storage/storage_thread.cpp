#include "core/storage/storage_thread.h"

#include <chrono>
#include <utility>

namespace jnd::core {
namespace {

using namespace std::chrono_literals;

constexpr auto kPoll = 1ms;
constexpr auto kPatience = 200ms;
constexpr auto kGlance = 20ms;

}  // namespace

StorageThread::StorageThread(SpscQueue<Sample>& samples, SampleConsumer consumer)
    : samples_(samples), consumer_(std::move(consumer)), thread_([this] { run(); }) {}

StorageThread::~StorageThread() {
  {
    const std::lock_guard guard(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void StorageThread::after(std::int64_t tick, const std::function<void()>& work,
                          const std::function<void()>& while_waiting) {
  std::unique_lock lock(mutex_);
  work_ = &work;
  work_tick_ = tick;
  work_was_done_ = false;
  wake_.notify_one();
  while (!done_.wait_for(lock, kGlance, [&] { return work_ == nullptr; })) {
    if (while_waiting) while_waiting();
  }
  if (!work_was_done_) throw StorageError(loss_);
  if (work_failure_) std::rethrow_exception(std::exchange(work_failure_, nullptr));
}

void StorageThread::commit(StudyStore& store, const Commit& commit,
                           const std::function<void()>& while_waiting) {
  after(
      commit.event.last_tick.value_or(-1), [&] { consumer_.commit(store, commit); },
      while_waiting);
}

void StorageThread::take_samples() {
  std::string loss;
  try {
    samples_.drain([this](const Sample& sample) {
      consumer_.take(sample);
      last_taken_tick_ = sample.tick;
    });
    return;
  } catch (const std::exception& error) {
    loss = error.what();
  } catch (...) {
    loss = "recording: expected to keep a sample, found that it cannot be";
  }
  // The waiting samples are given up as well, because the disk has had its time.
  samples_.drain([](const Sample&) {});
  const std::lock_guard guard(mutex_);
  if (loss_.empty()) loss_ = loss + "; samples were lost: leave the session, then resume it";
}

void StorageThread::do_work(std::unique_lock<std::mutex>& lock) {
  const std::function<void()>& work = *work_;
  std::exception_ptr failure;
  lock.unlock();
  try {
    work();
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  work_failure_ = failure;
  work_was_done_ = true;
}

void StorageThread::run() {
  std::unique_lock lock(mutex_);
  auto last_progress = std::chrono::steady_clock::now();
  while (true) {
    const bool ending = ending_;
    lock.unlock();
    const std::int64_t before = last_taken_tick_;
    take_samples();
    const auto now = std::chrono::steady_clock::now();
    if (last_taken_tick_ != before) last_progress = now;
    lock.lock();
    const bool is_due = last_taken_tick_ >= work_tick_ || now - last_progress > kPatience;
    if (work_ != nullptr && (is_due || !loss_.empty())) {
      if (loss_.empty()) do_work(lock);
      work_ = nullptr;
      done_.notify_one();
      continue;
    }
    if (ending) return;
    wake_.wait_for(lock, kPoll);
  }
}

}  // namespace jnd::core
