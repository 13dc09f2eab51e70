#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "core/error.h"
#include "core/exchange/spsc_queue.h"
#include "core/sample.h"
#include "core/storage/recording.h"
#include "core/storage/study_store.h"

namespace jnd::core {

/// The disk did not keep what it was asked to keep. The act counts as not done.
class StorageError : public Error {
 public:
  using Error::Error;
};

/// Where the samples of a loop go: to the recording, and to a function that watches them.
struct SampleConsumer {
  RecordingWriter* recording = nullptr;      ///< nullptr if nothing is recorded.
  std::function<void(const Sample&)> visit;  ///< Called for every sample; may be empty.

  void take(const Sample& sample) const {
    if (visit) visit(sample);
    if (recording != nullptr) recording->append(sample);
  }
  /// Syncs the recording up to here, then writes and syncs the commit.
  void commit(StudyStore& store, const Commit& commit) const {
    if (recording != nullptr && commit.event.last_tick) recording->flush();
    store.append(commit);
  }
};

/// The one thread that writes a session. It takes the loop's samples from their queue, passes
/// them to the recording, and does other work in between. So the recording is on disk before
/// the event that refers to it. A sample that could not be written leaves a hole, and no event
/// may refer to missing samples. So every later call throws, even if the disk has recovered.
class StorageThread {
 public:
  /// `samples` and the consumer's recording must outlive the thread.
  StorageThread(SpscQueue<Sample>& samples, SampleConsumer consumer);
  /// Takes what is left in the queue, then ends.
  ~StorageThread();
  StorageThread(const StorageThread&) = delete;
  StorageThread& operator=(const StorageThread&) = delete;

  /// Runs `work` on the storage thread once every sample up to `tick` has been taken (-1: at
  /// once), and returns when it is done. Throws what `work` threw. Once a sample was lost, it
  /// throws `StorageError` and does not call `work`. A tick that never comes, because its
  /// sample was dropped or the loop stands still, counts as taken after a fifth of a second
  /// without samples. `while_waiting`, if any, is called every 20 ms in the calling thread. Not
  /// real time.
  void after(std::int64_t tick, const std::function<void()>& work,
             const std::function<void()>& while_waiting = {});

  /// Syncs the recording up to `commit`'s last tick, then writes and syncs the commit.
  void commit(StudyStore& store, const Commit& commit,
              const std::function<void()>& while_waiting = {});

 private:
  void run();
  void take_samples();
  void do_work(std::unique_lock<std::mutex>& lock);

  SpscQueue<Sample>& samples_;
  SampleConsumer consumer_;
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  const std::function<void()>* work_ = nullptr;
  std::int64_t work_tick_ = -1;
  std::exception_ptr work_failure_;
  bool work_was_done_ = false;
  std::string loss_;  ///< Why samples were lost; "" if none were.
  bool ending_ = false;
  std::int64_t last_taken_tick_ = -1;
  std::thread thread_;
};

}  // namespace jnd::core
