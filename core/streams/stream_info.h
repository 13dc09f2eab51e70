#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/stream_sample.h"
#include "core/streams/xml_element.h"

namespace jnd::core {

/// What a channel of ours is, for whoever records it.
struct StreamChannel {
  std::string label;  ///< "hand_force_x_n"
  std::string unit;   ///< "N"; "" without one.
  std::string type;   ///< "Force"
};

/// The protocol that we speak, as the network spells it: 1.10.
inline constexpr int kStreamProtocol = 110;
/// Nobody has more; what says that it has is no stream.
inline constexpr int kMostStreamChannels = 4096;

/// What a stream says of itself to whoever looks for one (docs/lab_streaming_layer.md).
struct StreamInfo {
  std::string name, type;
  int channel_count = 1;
  double nominal_rate_hz = 0.0;  ///< 0: a sample comes whenever something happens.
  ChannelFormat format = ChannelFormat::kFloat32;
  /// The same whenever the program is started anew; "": there is nothing of the kind.
  std::string source_id;
  int version = kStreamProtocol;
  double created_at_s = 0.0;  ///< By the sender's clock.
  std::string uid;            ///< Of this outlet and no other.
  std::string session_id = "default";
  std::string hostname;
  std::string v4_address;
  std::uint16_t v4_data_port = 0, v4_service_port = 0;
  // Of ours, for the description.
  std::vector<StreamChannel> channels;
  std::vector<std::pair<std::string, std::string>> facts;  ///< "session" is "12".
};

/// As an outlet tells it: `with_description` what is longer and asked for once. Not real time.
[[nodiscard]] XmlElement stream_xml(const StreamInfo& info, bool with_description);

/// The inverse, without the description. Throws `Error` naming `place` for what no stream can
/// say: no name or identity, a number that is none, too many channels, an unknown format.
[[nodiscard]] StreamInfo stream_info_from(const XmlElement& xml, const std::string& place);
[[nodiscard]] StreamInfo stream_info_from(std::string_view xml, const std::string& place);

/// As streams spell numbers, whatever the locale: the shortest text that is this one.
[[nodiscard]] std::string stream_number(double value);

/// Sixteen random bytes as the text of an identity (RFC 4122, version 4).
[[nodiscard]] std::string new_stream_uid();

}  // namespace jnd::core
