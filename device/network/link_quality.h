#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace jnd::device {

/// The quality of a connection, in the four levels of KUKA's fast robot interface. With a poor
/// one nothing new is armed, with an unacceptable one no force is given.
enum class LinkLevel : std::uint8_t { kUnacceptable = 0, kPoor = 1, kGood = 2, kExcellent = 3 };

/// Returns "good" and its like, as JSON spells them. Real time.
[[nodiscard]] std::string_view name(LinkLevel level) noexcept;

/// Counts of the other side's datagrams since the device was opened.
struct LinkCounts {
  std::int64_t received = 0;   ///< Datagrams of this connection, each counted once.
  std::int64_t lost = 0;       ///< Never came, or not yet.
  std::int64_t late = 0;       ///< Ticks in which nothing new had come.
  std::int64_t doubled = 0;    ///< Came again, or long after their time, and were dropped.
  std::int64_t reordered = 0;  ///< Came after a newer one.
  std::int64_t refused = 0;    ///< Were no valid datagrams, see `wire::Problem`.
};

/// Judges a connection by the sequence numbers of what arrives; the numbers may wrap.
///
/// | level        | missing of the last 0.512 s | round trip, smoothed |
/// | ------------ | --------------------------- | -------------------- |
/// | excellent    | at most 1 of 512            | at most 4 ms         |
/// | good         | at most 10 of 512           | at most 8 ms         |
/// | poor         | at most 51 of 512           | at most 16 ms        |
/// | unacceptable | more                        | more                 |
///
/// The quality is also unacceptable until the datagrams of 50 ms have come. It is not settled
/// before a round trip has been measured. Times are converted to numbers of datagrams by the
/// sender's rate. A round trip lasts from the sending of a datagram until the first answer that
/// had seen it is taken in. So it includes the waiting for the ticks of both sides: two periods
/// and the network. One thread may use it; real time.
class LinkQuality {
 public:
  enum class Verdict {
    kNewest,     ///< Newer than all before.
    kReordered,  ///< Older than the newest, but new to us.
    kRepeated,   ///< Seen before, or too old to tell, or from before the first one.
  };

  LinkQuality() noexcept { restart(); }

  /// Begins another stream of datagrams, whose numbers start again. Its quality has to be shown
  /// again. The counts continue, and so does our clock, of which no echo counts twice.
  /// `rate_hz` > 0 is the number of datagrams in a second; below 100 counts as 100, above
  /// 16,000 as 16,000.
  void restart(double rate_hz = 1000.0) noexcept;
  /// Judges anew in the middle of a stream whose numbers continue. The numbers from before stay
  /// known, so that nothing old counts as new.
  void judge_anew() noexcept;
  [[nodiscard]] Verdict received(std::uint32_t sequence) noexcept;
  void refused() noexcept { ++counts_.refused; }
  /// Takes what the other side says it has seen last of our clock; 0 means nothing. It measures
  /// a round trip only if it is newer than all before and not from the future. Otherwise it
  /// tells nothing.
  void echoed(std::int64_t echo_ns, std::int64_t now_ns) noexcept;
  /// Call it once in each tick of the receiver, after it has taken in what had arrived.
  void end_tick() noexcept;

  [[nodiscard]] LinkLevel level() const noexcept;
  /// Whether the quality has been at least good for the required time, up to now.
  [[nodiscard]] bool is_settled() const noexcept {
    return num_good_ >= good_for_ && has_round_trip_;
  }
  /// Whether too many datagrams in a row were lost since `restart`.
  [[nodiscard]] bool is_broken() const noexcept { return broken_; }
  /// Since `restart`.
  [[nodiscard]] bool has_round_trip() const noexcept { return has_round_trip_; }
  /// Smoothed over some 16 round trips; 0 before the first one.
  [[nodiscard]] double round_trip_s() const noexcept { return 1e-9 * round_trip_ns_; }
  /// Returns our own clock as the other side had seen it last. What was sent later may not have
  /// arrived. 0 for nothing yet.
  [[nodiscard]] std::int64_t last_echo_ns() const noexcept { return last_echo_ns_; }
  [[nodiscard]] const LinkCounts& counts() const noexcept { return counts_; }

 private:
  static constexpr std::uint32_t kRing = 8192;  ///< Size of the largest window, a power of 2.

  [[nodiscard]] bool is_marked(std::uint32_t sequence) const noexcept;
  void mark(std::uint32_t sequence, bool came) noexcept;
  void advance_to(std::uint32_t sequence) noexcept;

  void forget() noexcept;

  std::uint32_t window_ = 512;  ///< Number of datagrams that are judged.
  std::uint32_t fewest_ = 50;   ///< Smallest number for a judgement.
  /// This many losses in a row break the connection, as with libfranka.
  std::uint32_t most_in_a_row_ = 20;
  /// Datagrams in a row that are at least good before the connection is settled.
  int good_for_ = 100;
  LinkCounts counts_;
  bool has_newest_ = false;
  std::uint32_t newest_ = 0;
  std::uint32_t num_expected_ = 0;  ///< Within the window, up to its size.
  std::uint32_t num_came_ = 0;      ///< Those of them that came.
  /// One bit for each sequence number, modulo the ring; no bits outside of the window.
  std::array<std::uint64_t, kRing / 64> came_{};
  bool came_in_tick_ = false;
  bool broken_ = false;
  int num_good_ = 0;
  bool has_round_trip_ = false;
  double round_trip_ns_ = 0.0;
  std::int64_t last_echo_ns_ = 0;
};

}  // namespace jnd::device
