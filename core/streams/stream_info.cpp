#include "core/streams/stream_info.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <random>

#include "core/error.h"

namespace jnd::core {
namespace {

/// Returns the part of a foreign text that may appear in a message of ours.
std::string shown_of_stream(const std::string& text) {
  std::string shown;
  for (const char letter : text.substr(0, 40)) {
    shown += letter >= 0x20 && letter < 0x7F ? letter : '?';
  }
  return shown;
}

class InfoFields {
 public:
  InfoFields(const XmlElement& xml, const std::string& place) : xml_(xml), place_(place) {}

  [[noreturn]] void refuse(const char* field, const std::string& expected) const {
    throw Error(place_ + ": expected <" + field + "> to be " + expected + ", found `" +
                shown_of_stream(xml_.child_text(field)) + "`");
  }

  [[nodiscard]] double number(const char* field, double least, double most) const {
    const std::string text = xml_.child_text(field);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() ||
        !(value >= least && value <= most)) {
      refuse(field, "a number from " + stream_number(least) + " to " + stream_number(most));
    }
    return value;
  }

  /// Returns 0 if it is left out, because an outlet may lack such a port.
  [[nodiscard]] std::uint16_t port(const char* field) const {
    return xml_.child_text(field).empty() ? std::uint16_t{0}
                                          : static_cast<std::uint16_t>(number(field, 0, 65535));
  }

  [[nodiscard]] std::string text(const char* field) const { return xml_.child_text(field); }

 private:
  const XmlElement& xml_;
  const std::string& place_;
};

void add_description(XmlElement& desc, const StreamInfo& info) {
  for (const auto& [fact, value] : info.facts) desc.add(fact, value);
  if (info.channels.empty()) return;
  XmlElement& channels = desc.add("channels");
  for (const StreamChannel& one : info.channels) {
    XmlElement& channel = channels.add("channel");
    channel.add("label", one.label);
    if (!one.unit.empty()) channel.add("unit", one.unit);
    if (!one.type.empty()) channel.add("type", one.type);
  }
}

}  // namespace

std::string stream_number(double value) {
  std::array<char, 32> text;
  char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

XmlElement stream_xml(const StreamInfo& info, bool with_description) {
  XmlElement xml{.name = "info"};
  xml.add("name", info.name);
  xml.add("type", info.type);
  xml.add("channel_count", std::to_string(info.channel_count));
  xml.add("channel_format", std::string(name(info.format)));
  xml.add("source_id", info.source_id);
  xml.add("nominal_srate", stream_number(info.nominal_rate_hz));
  xml.add("version", stream_number(info.version / 100.0));
  xml.add("created_at", stream_number(info.created_at_s));
  xml.add("uid", info.uid);
  xml.add("session_id", info.session_id);
  xml.add("hostname", info.hostname);
  xml.add("v4address", info.v4_address);
  xml.add("v4data_port", std::to_string(info.v4_data_port));
  xml.add("v4service_port", std::to_string(info.v4_service_port));
  xml.add("v6address");
  xml.add("v6data_port", "0");
  xml.add("v6service_port", "0");
  XmlElement& desc = xml.add("desc");
  if (with_description) add_description(desc, info);
  return xml;
}

StreamInfo stream_info_from(const XmlElement& xml, const std::string& place) {
  if (xml.name != "info") throw Error(place + ": expected <info> of a stream, found another");
  const InfoFields fields(xml, place);
  StreamInfo info;
  info.name = fields.text("name");
  if (info.name.empty()) fields.refuse("name", "some name");
  info.type = fields.text("type");
  info.channel_count = static_cast<int>(fields.number("channel_count", 1, kMostStreamChannels));
  constexpr double kFastest_hz = 1e9;
  info.nominal_rate_hz = fields.number("nominal_srate", 0.0, kFastest_hz);
  const auto format = channel_format_of(fields.text("channel_format"));
  if (!format) fields.refuse("channel_format", "a format of channels, as float32");
  info.format = *format;
  info.source_id = fields.text("source_id");
  constexpr double kNewest = 100.0;
  info.version = static_cast<int>(std::lround(100.0 * fields.number("version", 0.01, kNewest)));
  constexpr double kLatest_s = 1e12;
  info.created_at_s = fields.number("created_at", -kLatest_s, kLatest_s);
  info.uid = fields.text("uid");
  if (info.uid.empty()) fields.refuse("uid", "an identity");
  info.session_id = fields.text("session_id");
  info.hostname = fields.text("hostname");
  info.v4_address = fields.text("v4address");
  info.v4_data_port = fields.port("v4data_port");
  info.v4_service_port = fields.port("v4service_port");
  return info;
}

StreamInfo stream_info_from(std::string_view xml, const std::string& place) {
  return stream_info_from(parse_xml(xml, place), place);
}

std::string new_stream_uid() {
  std::random_device random;
  std::array<unsigned, 4> words;
  for (unsigned& word : words) word = random();
  words[1] = (words[1] & 0xFFFF0FFFU) | 0x00004000U;
  words[2] = (words[2] & 0x3FFFFFFFU) | 0x80000000U;
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%08x-%04x-%04x-%04x-%04x%08x", words[0],
                words[1] >> 16, words[1] & 0xFFFFU, words[2] >> 16, words[2] & 0xFFFFU,
                words[3]);
  return text.data();
}

}  // namespace jnd::core
