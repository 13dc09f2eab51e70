#include <bit>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/error.h"
#include "experiments/session/event.h"
#include "experiments/session/session_state.h"
#include "fuzz/fuzz_check.h"

namespace {

using namespace jnd;
using namespace jnd::experiments;

/// Reads one line. An input is a session with an event in each line, whose columns are
/// separated by semicolons:
/// kind;stage;trial;attempt;first_tick;last_tick;intensity;supersedes;data
class RowText {
 public:
  explicit RowText(std::string_view line) : rest_(line) {}

  std::string_view word() {
    const std::size_t end = std::min(rest_.find(';'), rest_.size());
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return word;
  }
  template <typename Number>
  std::optional<Number> number() {
    const std::string_view digits = word();
    Number value{};
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc() ? std::optional(value) : std::nullopt;
  }
  [[nodiscard]] std::string rest() const { return std::string(rest_); }

 private:
  std::string_view rest_;
};

core::EventRow row_of(std::string_view line, std::int64_t sequence) {
  RowText in(line);
  core::EventRow row{.session = 1, .sequence = sequence, .time_ns = sequence * 1000};
  row.kind = in.word();
  row.stage = in.number<std::int64_t>();
  row.trial = in.number<std::int64_t>();
  row.attempt = in.number<std::int64_t>();
  row.first_tick = in.number<std::int64_t>();
  row.last_tick = in.number<std::int64_t>();
  row.intensity = in.number<double>();
  row.supersedes = in.number<std::int64_t>();
  row.data = in.rest();
  return row;
}

auto columns_of(const core::EventRow& row) {
  // The bits are compared, so that NaN equals itself.
  const auto intensity = row.intensity
                             ? std::optional(std::bit_cast<std::uint64_t>(*row.intensity))
                             : std::nullopt;
  return std::tuple(row.session, row.sequence, row.kind, row.version, row.time_ns, row.stage,
                    row.trial, row.attempt, row.first_tick, row.last_tick, intensity,
                    row.supersedes, row.data);
}

/// Expects that an event is refused with a sentence only if the log may not hold it, and that
/// nothing else is lost.
void check_event(const core::EventRow& row, SessionState& state) {
  const Event event = event_from_row(row);
  const core::EventRow stored = row_from_event(row.session, event);
  const Event again = event_from_row(stored);
  fuzz::property(columns_of(row_from_event(row.session, again)) == columns_of(stored),
                 "what was stored reads back: " + stored.data);
  apply(state, event);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, size);
  SessionState state;
  std::int64_t sequence = 0;
  int num_refused = 0;
  for (std::size_t begin = 0; begin < text.size() && num_refused < 8;) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    try {
      check_event(row_of(line, sequence + 1), state);
      ++sequence;
      fuzz::property(state.last_sequence == sequence, "the fold counts its events");
    } catch (const core::Error& error) {
      fuzz::check_sentence(error.what());
      // A session would end at the first refusal. A few more make a seed more useful.
      ++num_refused;
    }
  }
  static_cast<void>(state.current_trial());
  static_cast<void>(state.last_answered_trial());
  static_cast<void>(state.answered_in(state.stage));
  return 0;
}
