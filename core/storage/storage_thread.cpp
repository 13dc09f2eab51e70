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
  wake_.notify_one();
  while (!done_.wait_for(lock, kGlance, [&] { return work_ == nullptr; })) {
    if (while_waiting) while_waiting();
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void StorageThread::commit(StudyStore& store, const Commit& commit,
                           const std::function<void()>& while_waiting) {
  after(
      commit.event.last_tick.value_or(-1), [&] { consumer_.commit(store, commit); },
      while_waiting);
}

void StorageThread::take_samples() {
  samples_.drain([this](const Sample& sample) {
    consumer_.take(sample);
    last_taken_tick_ = sample.tick;
  });
}

void StorageThread::run() {
  std::unique_lock lock(mutex_);
  auto last_progress = std::chrono::steady_clock::now();
  while (true) {
    const bool ending = ending_;
    lock.unlock();
    const std::int64_t before = last_taken_tick_;
    std::exception_ptr failure;
    try {
      take_samples();
    } catch (...) {
      // What could not be written is given up; whoever waits or asks next is told.
      failure = std::current_exception();
      samples_.drain([](const Sample&) {});
    }
    const auto now = std::chrono::steady_clock::now();
    if (last_taken_tick_ != before) last_progress = now;
    lock.lock();
    if (failure && !failure_) failure_ = failure;
    if (work_ != nullptr) {
      const bool due = last_taken_tick_ >= work_tick_ || now - last_progress > kPatience;
      if (failure_ || due) {
        if (!failure_) {
          const std::function<void()>& work = *work_;
          lock.unlock();
          try {
            work();
          } catch (...) {
            failure = std::current_exception();
          }
          lock.lock();
          if (failure) failure_ = failure;
        }
        work_ = nullptr;
        done_.notify_one();
        continue;
      }
    }
    if (ending) return;
    wake_.wait_for(lock, kPoll);
  }
}

}  // namespace jnd::core
