#include "core/streams/stream_info.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/error.h"
#include "core/streams/stream_query.h"

namespace jnd::core {
namespace stream_info_test {

StreamInfo amplifier() {
  return {.name = "Amplifier",
          .type = "EEG",
          .channel_count = 2,
          .nominal_rate_hz = 500.0,
          .format = ChannelFormat::kFloat32,
          .source_id = "amp-7",
          .created_at_s = 12.125,
          .uid = "1234",
          .hostname = "lab",
          .v4_data_port = 16572,
          .v4_service_port = 16573,
          .channels = {{"Fp1", "microvolts", "EEG"}, {"Fp2", "", ""}},
          .facts = {{"session", "12"}}};
}

TEST(StreamInfo, IsReadBackAsItWasWritten) {
  const StreamInfo told = amplifier();
  const StreamInfo read = stream_info_from(xml_text(stream_xml(told, true)), "test");
  EXPECT_EQ(read.name, told.name);
  EXPECT_EQ(read.type, told.type);
  EXPECT_EQ(read.channel_count, told.channel_count);
  EXPECT_EQ(read.nominal_rate_hz, told.nominal_rate_hz);
  EXPECT_EQ(read.format, told.format);
  EXPECT_EQ(read.source_id, told.source_id);
  EXPECT_EQ(read.version, 110);
  EXPECT_EQ(read.created_at_s, told.created_at_s);
  EXPECT_EQ(read.uid, told.uid);
  EXPECT_EQ(read.session_id, "default");
  EXPECT_EQ(read.hostname, told.hostname);
  EXPECT_EQ(read.v4_data_port, told.v4_data_port);
  EXPECT_EQ(read.v4_service_port, told.v4_service_port);
}

TEST(StreamInfo, DescribesChannelsOnlyWhereAsked) {
  const XmlElement full = stream_xml(amplifier(), true);
  const XmlElement* desc = full.child("desc");
  ASSERT_NE(desc, nullptr);
  EXPECT_EQ(desc->child_text("session"), "12");
  ASSERT_EQ(desc->child("channels")->children.size(), 2U);
  EXPECT_EQ(desc->child("channels")->children[0].child_text("unit"), "microvolts");
  EXPECT_EQ(desc->child("channels")->children[1].child("unit"), nullptr);
  EXPECT_TRUE(stream_xml(amplifier(), false).child("desc")->children.empty());
}

TEST(StreamInfo, UnderstandsNumbersAsOthersWriteThem) {
  const std::string text =
      "<info><name>a</name><type></type><channel_count>8</channel_count>"
      "<nominal_srate>1000.000000000000</nominal_srate>"
      "<channel_format>int16</channel_format><version>1.1000000000000001</version>"
      "<created_at>50942.723319709003</created_at><uid>u</uid></info>";
  const StreamInfo read = stream_info_from(text, "test");
  EXPECT_EQ(read.version, 110);
  EXPECT_EQ(read.nominal_rate_hz, 1000.0);
  EXPECT_EQ(read.v4_data_port, 0);
}

TEST(StreamInfo, WhatNoStreamCanSayIsRefused) {
  const std::string sound = xml_text(stream_xml(amplifier(), false));
  const auto with = [&sound](const std::string& old, const std::string& other) {
    std::string text = sound;
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return text.replace(at, old.size(), other);
  };
  for (const std::string& text : {
           with("<name>Amplifier</name>", "<name></name>"),
           with("<channel_count>2<", "<channel_count>0<"),
           with("<channel_count>2<", "<channel_count>2000000000<"),
           with("<channel_count>2<", "<channel_count>-1<"),
           with("<nominal_srate>500<", "<nominal_srate>nan<"),
           with("<nominal_srate>500<", "<nominal_srate>-1<"),
           with("float32", "float16"),
           with("<uid>1234<", "<uid><"),
           with("<v4data_port>16572<", "<v4data_port>70000<"),
           with("<created_at>12.125<", "<created_at>\x01soon<"),
       }) {
    try {
      (void)stream_info_from(text, "stream");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find('\x01'), std::string::npos);
    }
  }
}

TEST(StreamInfo, EveryIdentityIsAnother) {
  std::set<std::string> all;
  for (int i = 0; i < 100; ++i) all.insert(new_stream_uid());
  EXPECT_EQ(all.size(), 100U);
  EXPECT_EQ(all.begin()->size(), 36U);
  EXPECT_EQ((*all.begin())[14], '4');
}

TEST(StreamQuery, FindsWhatItAsksFor) {
  const XmlElement info = stream_xml(amplifier(), true);
  for (const char* query :
       {"", "  ", "name='Amplifier'", "session_id='default' and type=\"EEG\"",
        "channel_count='2' and name='Amplifier' and type='EEG' and source_id='amp-7' and "
        "channel_format='float32'",
        "type='MEG' or type='EEG'", "not(type='MEG')", "type!='MEG'", "nominal_srate=500",
        "starts-with(name,'Amp') and contains( type , 'E' )", "desc/session='12'",
        "(type='MEG' or name='Amplifier') and session_id='default'", "desc/channels",
        "source_id"}) {
    EXPECT_TRUE(matches_query(info, query)) << query;
  }
}

TEST(StreamQuery, LeavesOutTheRest) {
  const XmlElement info = stream_xml(amplifier(), true);
  for (const char* query : {"name='amplifier'",
                            "session_id='other' and type='EEG'",
                            "type='MEG'",
                            "not(type='EEG')",
                            "nothing='x'",
                            "nothing!='x'",
                            "nothing",
                            "desc/nothing='12'",
                            "nominal_srate=501",
                            "type='EEG' and",
                            "type='EEG",
                            "type=='EEG'",
                            "(type='EEG'",
                            "type='EEG')",
                            "//type='EEG'",
                            "count(desc/channels)=1",
                            "name='Amplifier' orr 1",
                            "'",
                            "=",
                            "((((((((((((((((((((type='EEG'))))))))))))))))))))"}) {
    EXPECT_FALSE(matches_query(info, query)) << query;
  }
}

TEST(StreamQuery, QuotesWhateverANameHolds) {
  StreamInfo info = amplifier();
  for (const std::string& name : {std::string("a"), std::string("it's"), std::string("\"so\""),
                                  std::string("x' or name!='")}) {
    info.name = name;
    const XmlElement xml = stream_xml(info, false);
    EXPECT_TRUE(matches_query(xml, "name=" + quoted_for_query(name))) << name;
    info.name = "another";
    EXPECT_FALSE(matches_query(stream_xml(info, false), "name=" + quoted_for_query(name)))
        << name;
  }
}

}  // namespace stream_info_test
}  // namespace jnd::core
