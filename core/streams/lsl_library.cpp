#include "core/streams/lsl_library.h"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>

#include "core/error.h"

// The part of the library's C interface that is used, as its documentation describes it.
struct lsl_streaminfo_struct_;
struct lsl_outlet_struct_;
struct lsl_inlet_struct_;
struct lsl_xml_ptr_struct_;

namespace jnd::core {

struct LslLibrary::Functions {
  using Info = lsl_streaminfo_struct_*;
  using Outlet = lsl_outlet_struct_*;
  using Inlet = lsl_inlet_struct_*;
  using Xml = lsl_xml_ptr_struct_*;

  int (*library_version)() = nullptr;
  double (*local_clock)() = nullptr;
  Info (*create_streaminfo)(const char*, const char*, int, double, int, const char*) = nullptr;
  void (*destroy_streaminfo)(Info) = nullptr;
  Xml (*get_desc)(Info) = nullptr;
  Xml (*append_child)(Xml, const char*) = nullptr;
  Xml (*append_child_value)(Xml, const char*, const char*) = nullptr;
  char* (*get_xml)(Info) = nullptr;
  Outlet (*create_outlet)(Info, int, int) = nullptr;
  void (*destroy_outlet)(Outlet) = nullptr;
  Info (*get_info)(Outlet) = nullptr;
  int (*have_consumers)(Outlet) = nullptr;
  int (*push_sample_vtp)(Outlet, const void*, double, int) = nullptr;
  int (*push_sample_buftp)(Outlet, const char**, const unsigned*, double, int) = nullptr;
  int (*resolve_bypred)(Info*, unsigned, const char*, int, double) = nullptr;
  Inlet (*create_inlet)(Info, int, int, int) = nullptr;
  void (*destroy_inlet)(Inlet) = nullptr;
  Info (*get_fullinfo)(Inlet, double, int*) = nullptr;
  double (*pull_sample_v)(Inlet, void*, int, double, int*) = nullptr;
  double (*pull_sample_buf)(Inlet, char**, unsigned*, int, double, int*) = nullptr;
  double (*time_correction)(Inlet, double, int*) = nullptr;
  // Not every version has these functions.
  double (*time_correction_ex)(Inlet, double*, double*, double, int*) = nullptr;
  void (*destroy_string)(char*) = nullptr;

  /// Returns the text as our own string and lets the library free its copy.
  [[nodiscard]] std::string taken(char* text) const {
    if (text == nullptr) return "";
    std::string copy = text;
    let_go(text);
    return copy;
  }
  void let_go(char* text) const {
    if (destroy_string != nullptr) {
      destroy_string(text);
    } else {
      std::free(text);
    }
  }
};

namespace {

using Lsl = LslLibrary::Functions;

struct InfoDeleter {
  const Lsl* lsl;
  void operator()(lsl_streaminfo_struct_* info) const { lsl->destroy_streaminfo(info); }
};
using InfoHandle = std::unique_ptr<lsl_streaminfo_struct_, InfoDeleter>;

InfoHandle held(const Lsl& lsl, lsl_streaminfo_struct_* info, const char* what) {
  if (info == nullptr) {
    throw Error(std::string("liblsl: expected ") + what + ", found that it gives none");
  }
  return {info, {&lsl}};
}

/// The library numbers formats from 1.
int library_format(ChannelFormat format) { return static_cast<int>(format) + 1; }

InfoHandle library_info(const Lsl& lsl, const StreamInfo& info) {
  InfoHandle handle =
      held(lsl,
           lsl.create_streaminfo(info.name.c_str(), info.type.c_str(), info.channel_count,
                                 info.nominal_rate_hz, library_format(info.format),
                                 info.source_id.c_str()),
           "a description of a stream");
  auto* const desc = lsl.get_desc(handle.get());
  for (const auto& [fact, value] : info.facts) {
    lsl.append_child_value(desc, fact.c_str(), value.c_str());
  }
  if (info.channels.empty()) return handle;
  auto* const channels = lsl.append_child(desc, "channels");
  for (const StreamChannel& one : info.channels) {
    auto* const channel = lsl.append_child(channels, "channel");
    lsl.append_child_value(channel, "label", one.label.c_str());
    if (!one.unit.empty()) lsl.append_child_value(channel, "unit", one.unit.c_str());
    if (!one.type.empty()) lsl.append_child_value(channel, "type", one.type.c_str());
  }
  return handle;
}

class LibraryOutlet final : public StreamOutlet {
 public:
  LibraryOutlet(std::shared_ptr<const LslLibrary> library, const StreamInfo& info,
                double seconds_kept)
      : library_(std::move(library)), lsl_(library_->functions()) {
    const InfoHandle handle = library_info(lsl_, info);
    outlet_ = lsl_.create_outlet(handle.get(), 0,
                                 std::max(1, static_cast<int>(std::lround(seconds_kept))));
    if (outlet_ == nullptr) throw Error("liblsl: expected an outlet, found that it gives none");
    const InfoHandle told = held(lsl_, lsl_.get_info(outlet_), "what its outlet is");
    info_ = stream_info_from(lsl_.taken(lsl_.get_xml(told.get())), "liblsl");
    info_.channels = info.channels;
    info_.facts = info.facts;
  }
  ~LibraryOutlet() override { lsl_.destroy_outlet(outlet_); }
  LibraryOutlet(const LibraryOutlet&) = delete;
  LibraryOutlet& operator=(const LibraryOutlet&) = delete;

  void push(const std::vector<StreamSample>& samples) override {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const StreamSample& sample = samples[i];
      const double time_s = sample.time_s + library_->clock_ahead_s();
      const int is_last = i + 1 == samples.size() ? 1 : 0;
      if (info_.format != ChannelFormat::kString) {
        (void)lsl_.push_sample_vtp(outlet_, sample.values.data(), time_s, is_last);
        continue;
      }
      std::vector<const char*> texts;
      std::vector<unsigned> sizes;
      for (const std::string& text : sample.texts) {
        texts.push_back(text.data());
        sizes.push_back(static_cast<unsigned>(text.size()));
      }
      (void)lsl_.push_sample_buftp(outlet_, texts.data(), sizes.data(), time_s, is_last);
    }
  }
  const StreamInfo& info() const noexcept override { return info_; }
  int num_consumers() const override { return lsl_.have_consumers(outlet_) != 0 ? 1 : 0; }
  // The library does not tell this number.
  std::int64_t num_dropped() const override { return 0; }

 private:
  std::shared_ptr<const LslLibrary> library_;
  const Lsl& lsl_;
  Lsl::Outlet outlet_ = nullptr;
  StreamInfo info_;
};

class LibraryInlet final : public StreamInlet {
 public:
  LibraryInlet(std::shared_ptr<const LslLibrary> library, const StreamInfo& info,
               double timeout_s)
      : library_(std::move(library)), lsl_(library_->functions()), info_(info) {
    // A description made from XML would lack the stream's address, so the stream is looked for
    // again.
    const std::string query = "uid='" + info.uid + "'";
    lsl_streaminfo_struct_* found = nullptr;
    if (lsl_.resolve_bypred(&found, 1, query.c_str(), 1, timeout_s) < 1) {
      throw Error("liblsl: expected the stream that was found, found it gone");
    }
    const InfoHandle wanted = held(lsl_, found, "a stream");
    constexpr int kSecondsKept = 60;
    inlet_ = lsl_.create_inlet(wanted.get(), kSecondsKept, 0, /*recover=*/1);
    if (inlet_ == nullptr) throw Error("liblsl: expected an inlet, found that it gives none");
    int error = 0;
    lsl_streaminfo_struct_* full = lsl_.get_fullinfo(inlet_, timeout_s, &error);
    if (full == nullptr) {
      lsl_.destroy_inlet(inlet_);
      throw Error("liblsl: expected the stream to describe itself, found code " +
                  std::to_string(error));
    }
    const InfoHandle told = held(lsl_, full, "a description");
    full_xml_ = lsl_.taken(lsl_.get_xml(told.get()));
    thread_ = std::thread([this] { listen(); });
  }
  ~LibraryInlet() override {
    is_ending_ = true;
    thread_.join();
    lsl_.destroy_inlet(inlet_);
  }
  LibraryInlet(const LibraryInlet&) = delete;
  LibraryInlet& operator=(const LibraryInlet&) = delete;

  std::vector<StreamSample> take_samples() override {
    const std::lock_guard guard(mutex_);
    return std::exchange(samples_, {});
  }
  std::vector<ClockOffset> take_offsets() override {
    const std::lock_guard guard(mutex_);
    return std::exchange(offsets_, {});
  }
  const StreamInfo& info() const noexcept override { return info_; }
  const std::string& full_xml() const noexcept override { return full_xml_; }
  State state() const override { return state_; }
  std::string problem() const override {
    return state_ == State::kLost ? "liblsl: expected more samples, found the stream gone" : "";
  }
  std::int64_t num_dropped() const override { return 0; }

 private:
  void listen() {
    constexpr double kGlance_s = 0.2;
    constexpr double kBetweenOffsets_s = 2.0;
    double next_offset_s = 0.0;
    while (!is_ending_) {
      int error = 0;
      StreamSample sample;
      sample.time_s = info_.format == ChannelFormat::kString
                          ? pull_texts(sample, kGlance_s, error)
                          : pull_values(sample, kGlance_s, error);
      if (error == kGone) {
        state_ = State::kLost;
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
      } else if (sample.time_s != 0.0) {
        state_ = State::kReceiving;
        const std::lock_guard guard(mutex_);
        samples_.push_back(std::move(sample));
      }
      if (stream_clock_s() < next_offset_s) continue;
      next_offset_s = stream_clock_s() + kBetweenOffsets_s;
      compare_clocks();
    }
  }

  double pull_values(StreamSample& sample, double timeout_s, int& error) {
    sample.values.resize(value_bytes(info_.format) *
                         static_cast<std::size_t>(info_.channel_count));
    return lsl_.pull_sample_v(inlet_, sample.values.data(),
                              static_cast<int>(sample.values.size()), timeout_s, &error);
  }

  double pull_texts(StreamSample& sample, double timeout_s, int& error) {
    const auto num_channels = static_cast<std::size_t>(info_.channel_count);
    std::vector<char*> texts(num_channels, nullptr);
    std::vector<unsigned> sizes(num_channels, 0);
    const double time_s = lsl_.pull_sample_buf(inlet_, texts.data(), sizes.data(),
                                               info_.channel_count, timeout_s, &error);
    if (time_s == 0.0) return 0.0;
    for (std::size_t i = 0; i < num_channels; ++i) {
      sample.texts.emplace_back(texts[i], sizes[i]);
      lsl_.let_go(texts[i]);
    }
    return time_s;
  }

  void compare_clocks() {
    constexpr double kPatience_s = 0.01;
    int error = 0;
    ClockOffset offset;
    if (lsl_.time_correction_ex != nullptr) {
      offset.offset_s = lsl_.time_correction_ex(inlet_, &offset.time_s, &offset.round_trip_s,
                                                kPatience_s, &error);
    } else {
      offset.offset_s = lsl_.time_correction(inlet_, kPatience_s, &error);
      offset.time_s = lsl_.local_clock() - offset.offset_s;
    }
    if (error != 0) return;
    offset.offset_s -= library_->clock_ahead_s();
    const std::lock_guard guard(mutex_);
    if (!offsets_.empty() && offsets_.back().time_s == offset.time_s) return;
    offsets_.push_back(offset);
  }

  static constexpr int kGone = -2;

  std::shared_ptr<const LslLibrary> library_;
  const Lsl& lsl_;
  StreamInfo info_;
  std::string full_xml_;
  Lsl::Inlet inlet_ = nullptr;
  std::mutex mutex_;
  std::vector<StreamSample> samples_;
  std::vector<ClockOffset> offsets_;
  std::atomic<State> state_{State::kConnecting};
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

}  // namespace

LslLibrary::LslLibrary(const std::string& file) : functions_(std::make_unique<Functions>()) {
  handle_ = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) {
    const char* why = ::dlerror();
    throw Error(file + ": expected a library of the Lab Streaming Layer, found: " +
                (why != nullptr ? why : "nothing"));
  }
  const auto find = [&](auto& function, const char* name, bool is_needed = true) {
    void* symbol = ::dlsym(handle_, name);
    if (symbol == nullptr && is_needed) {
      ::dlclose(handle_);
      throw Error(file + ": expected the function " + name +
                  " of liblsl 1.10 or newer, found "
                  "none");
    }
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(symbol);
  };
  Functions& lsl = *functions_;
  find(lsl.library_version, "lsl_library_version");
  find(lsl.local_clock, "lsl_local_clock");
  find(lsl.create_streaminfo, "lsl_create_streaminfo");
  find(lsl.destroy_streaminfo, "lsl_destroy_streaminfo");
  find(lsl.get_desc, "lsl_get_desc");
  find(lsl.append_child, "lsl_append_child");
  find(lsl.append_child_value, "lsl_append_child_value");
  find(lsl.get_xml, "lsl_get_xml");
  find(lsl.create_outlet, "lsl_create_outlet");
  find(lsl.destroy_outlet, "lsl_destroy_outlet");
  find(lsl.get_info, "lsl_get_info");
  find(lsl.have_consumers, "lsl_have_consumers");
  find(lsl.push_sample_vtp, "lsl_push_sample_vtp");
  find(lsl.push_sample_buftp, "lsl_push_sample_buftp");
  find(lsl.resolve_bypred, "lsl_resolve_bypred");
  find(lsl.create_inlet, "lsl_create_inlet");
  find(lsl.destroy_inlet, "lsl_destroy_inlet");
  find(lsl.get_fullinfo, "lsl_get_fullinfo");
  find(lsl.pull_sample_v, "lsl_pull_sample_v");
  find(lsl.pull_sample_buf, "lsl_pull_sample_buf");
  find(lsl.time_correction, "lsl_time_correction");
  find(lsl.time_correction_ex, "lsl_time_correction_ex", /*is_needed=*/false);
  find(lsl.destroy_string, "lsl_destroy_string", /*is_needed=*/false);
  const int version = lsl.library_version();
  words_ = "liblsl " + std::to_string(version / 100) + "." + std::to_string(version % 100) +
           " (" + file + ")";
  constexpr double kSameClock_s = 1e-3;
  const double ahead_s = lsl.local_clock() - stream_clock_s();
  if (std::abs(ahead_s) > kSameClock_s) clock_ahead_s_ = ahead_s;
}

/// The library stays loaded, because its threads may outlive the objects that they served.
LslLibrary::~LslLibrary() = default;

std::unique_ptr<StreamOutlet> open_library_outlet(std::shared_ptr<const LslLibrary> library,
                                                  const StreamInfo& info, double seconds_kept) {
  return std::make_unique<LibraryOutlet>(std::move(library), info, seconds_kept);
}

std::vector<StreamInfo> find_library_streams(const LslLibrary& library,
                                             const std::string& query, double timeout_s,
                                             int enough) {
  const Lsl& lsl = library.functions();
  constexpr unsigned kMostFound = 256;
  std::vector<lsl_streaminfo_struct_*> handles(kMostFound, nullptr);
  const int count = lsl.resolve_bypred(handles.data(), kMostFound, query.c_str(),
                                       enough > 0 ? enough : 1024, timeout_s);
  std::vector<StreamInfo> found;
  for (int i = 0; i < count; ++i) {
    const InfoHandle handle = held(lsl, handles[static_cast<std::size_t>(i)], "a stream");
    try {
      found.push_back(stream_info_from(lsl.taken(lsl.get_xml(handle.get())), "liblsl"));
    } catch (const Error&) {
      // That stream's description cannot be read; the other streams are returned.
    }
  }
  return found;
}

std::unique_ptr<StreamInlet> open_library_inlet(std::shared_ptr<const LslLibrary> library,
                                                const StreamInfo& info, double timeout_s) {
  return std::make_unique<LibraryInlet>(std::move(library), info, timeout_s);
}

}  // namespace jnd::core
