#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/streams/lsl_library.h"
#include "core/streams/stream_search.h"
#include "core/streams/stream_wire.h"
#include "loopback_network.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace jnd::core {
namespace lsl_oracle_test {

namespace fs = std::filesystem;

/// Returns the file of liblsl by other people, if JND_LIBLSL names one or the build folder has
/// one: `npm install --ignore-scripts --prefix build/oracle node-lsl`.
fs::path library_file() {
  if (const char* named = std::getenv("JND_LIBLSL")) return named;
  return test_support::source_folder() /
         "build/oracle/node_modules/node-lsl/prebuilt/liblsl64.so";
}

/// Returns the library, which is loaded once, with settings that keep it on this machine.
std::shared_ptr<const LslLibrary> library() {
  static const test_support::TemporaryFolder folder;
  static const std::shared_ptr<const LslLibrary> loaded = [] {
    const fs::path settings = folder.path() / "lsl_api.cfg";
    std::ofstream(settings) << "[ports]\nIPv6 = disable\n[multicast]\nResolveScope = machine\n"
                               "[lab]\nKnownPeers = {127.0.0.1}\n[log]\nlevel = -3\n";
    ::setenv("LSLAPICFG", settings.c_str(), 1);
    return std::make_shared<const LslLibrary>(library_file().string());
  }();
  return loaded;
}

class LslOracle : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(library_file())) {
      GTEST_SKIP() << "no liblsl at " << library_file() << "; JND_LIBLSL names one";
    }
    network_.session_id = "default";
  }

  [[nodiscard]] StreamInfo info_of(ChannelFormat format) const {
    return {.name = "oracle " + new_stream_uid(),
            .type = "Test",
            .channel_count = 3,
            .nominal_rate_hz = format == ChannelFormat::kString ? 0.0 : 200.0,
            .format = format,
            .source_id = new_stream_uid(),
            .channels = {{"a", "N", "Force"}, {"b", "m", "Position"}, {"c", "", ""}},
            .facts = {{"manufacturer", "nobody"}}};
  }

  static std::vector<StreamSample> samples_of(ChannelFormat format) {
    std::vector<StreamSample> samples;
    for (int i = 0; i < 20; ++i) {
      samples.push_back(test_sample(format, 3, i));
      samples.back().time_s = 1000.0 + 0.125 * i;
    }
    return samples;
  }

  StreamNetwork network_ = loopback_network();
};

constexpr ChannelFormat kFormats[] = {ChannelFormat::kFloat32, ChannelFormat::kDouble64,
                                      ChannelFormat::kString,  ChannelFormat::kInt32,
                                      ChannelFormat::kInt16,   ChannelFormat::kInt8,
                                      ChannelFormat::kInt64};

TEST_F(LslOracle, ReadsOurStreams) {
  for (const ChannelFormat format : kFormats) {
    const StreamInfo info = info_of(format);
    const auto outlet = open_own_outlet(info, network_);
    const auto found = find_library_streams(*library(), "name='" + info.name + "'", 10.0, 1);
    ASSERT_EQ(found.size(), 1U) << name(format);
    EXPECT_EQ(found[0].uid, outlet->info().uid);
    EXPECT_EQ(found[0].source_id, info.source_id);
    EXPECT_EQ(found[0].nominal_rate_hz, info.nominal_rate_hz);
    const auto inlet = open_library_inlet(library(), found[0]);
    const XmlElement full = parse_xml(inlet->full_xml(), "test");
    EXPECT_EQ(full.child("desc")->child("channels")->children[1].child_text("label"), "b");
    ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 1; })) << name(format);
    const auto sent = samples_of(format);
    outlet->push(sent);
    EXPECT_EQ(take_from(*inlet, sent.size()), sent) << name(format);
  }
}

TEST_F(LslOracle, ItsStreamsAreReadByUs) {
  for (const ChannelFormat format : kFormats) {
    const StreamInfo info = info_of(format);
    const auto outlet = open_library_outlet(library(), info);
    const auto found = find_streams(network_, query_for(network_, "name", info.name), 10.0, 1);
    ASSERT_EQ(found.size(), 1U) << name(format);
    const auto inlet = open_own_inlet(found[0], network_);
    EXPECT_EQ(parse_xml(inlet->full_xml(), "test").child("desc")->child_text("manufacturer"),
              "nobody");
    ASSERT_TRUE(comes_about([&] { return outlet->num_consumers() == 1; })) << name(format);
    const auto sent = samples_of(format);
    outlet->push(sent);
    EXPECT_EQ(take_from(*inlet, sent.size()), sent) << name(format);
  }
}

TEST_F(LslOracle, BothCompareClocksWithEachOther) {
  const StreamInfo info = info_of(ChannelFormat::kFloat32);
  constexpr double kBehind_s = 250.0;
  StreamNetwork late = network_;
  late.clock_s = [] { return stream_clock_s() - kBehind_s; };
  const auto ours = open_own_outlet(info, late);
  const auto ours_found = find_library_streams(*library(), "name='" + info.name + "'", 10.0, 1);
  ASSERT_EQ(ours_found.size(), 1U);
  const auto its_inlet = open_library_inlet(library(), ours_found[0]);
  const StreamInfo its_info = info_of(ChannelFormat::kFloat32);
  const auto its = open_library_outlet(library(), its_info);
  StreamNetwork early = network_;
  early.clock_s = [] { return stream_clock_s() + kBehind_s; };
  const auto its_found =
      find_streams(network_, query_for(network_, "name", its_info.name), 10.0, 1);
  ASSERT_EQ(its_found.size(), 1U);
  const auto our_inlet = open_own_inlet(its_found[0], early);
  std::vector<ClockOffset> by_it, by_us;
  ASSERT_TRUE(comes_about([&] {
    for (const ClockOffset& one : its_inlet->take_offsets()) by_it.push_back(one);
    for (const ClockOffset& one : our_inlet->take_offsets()) by_us.push_back(one);
    return !by_it.empty() && !by_us.empty();
  }));
  EXPECT_NEAR(by_it[0].offset_s, kBehind_s, 5e-3);
  EXPECT_NEAR(by_us[0].offset_s, kBehind_s, 0.5 * by_us[0].round_trip_s + 1e-3);
}

TEST(LslLibrary, WhatIsNoneIsToldInASentence) {
  EXPECT_THROW(LslLibrary("/nowhere/liblsl.so"), Error);
  EXPECT_THROW(LslLibrary("libm.so.6"), Error);
}

}  // namespace lsl_oracle_test
}  // namespace jnd::core
