#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/stream_sample.h"
#include "core/streams/xml_element.h"

namespace jnd::core {

/// Describes a channel of ours to other recorders.
struct StreamChannel {
  std::string label;  ///< "hand_force_x_n"
  std::string unit;   ///< "N"; "" if it has no unit.
  std::string type;   ///< "Force"
};

/// The protocol that we speak, 1.10, as the network spells it.
inline constexpr int kStreamProtocol = 110;
/// No stream has more channels. A description that claims more is refused.
inline constexpr int kMostStreamChannels = 4096;

/// What a stream says about itself to programs that look for one (docs/lab_streaming_layer.md).
struct StreamInfo {
  std::string name, type;
  int channel_count = 1;
  double nominal_rate_hz = 0.0;  ///< 0 if samples come at irregular times.
  ChannelFormat format = ChannelFormat::kFloat32;
  /// Stays the same when the program is restarted; "" if there is no such identity.
  std::string source_id;
  int version = kStreamProtocol;
  double created_at_s = 0.0;  ///< By the sender's clock.
  std::string uid;            ///< Identity of this outlet and of no other.
  std::string session_id = "default";
  std::string hostname;
  std::string v4_address;
  std::uint16_t v4_data_port = 0, v4_service_port = 0;
  // For the description of our own streams.
  std::vector<StreamChannel> channels;
  std::vector<std::pair<std::string, std::string>> facts;  ///< For example, "session" is "12".
};

/// Returns the XML that an outlet sends. `with_description` adds the longer part, which is
/// requested once. Not real time.
[[nodiscard]] XmlElement stream_xml(const StreamInfo& info, bool with_description);

/// Reads the XML, without the description. Throws `Error` naming `place` for what no stream can
/// say: a missing name or identity, an invalid number, too many channels or an unknown format.
[[nodiscard]] StreamInfo stream_info_from(const XmlElement& xml, const std::string& place);
[[nodiscard]] StreamInfo stream_info_from(std::string_view xml, const std::string& place);

/// Returns the shortest text that gives this number again, as streams spell numbers in any
/// locale.
[[nodiscard]] std::string stream_number(double value);

/// Returns sixteen random bytes as the text of an identity (RFC 4122, version 4).
[[nodiscard]] std::string new_stream_uid();

}  // namespace jnd::core
