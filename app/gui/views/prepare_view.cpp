#include "app/gui/views/prepare_view.h"

#include <algorithm>
#include <string>
#include <utility>

#include "app/gui/views/layout.h"
#include "app/language/words.h"
#include "app/operator/study_words.h"
#include "app/session/fitting.h"
#include "app/session/pseudonym.h"

namespace jnd::app::gui {
namespace {

using Status = PreflightLine::Status;

/// Why nobody can take part under this pseudonym; "" if somebody can.
std::string participant_problem(const PrepareModel& model, const std::string& participant) {
  if (participant.empty()) return tr("Choose a participant.");
  if (!is_pseudonym(participant)) {
    std::string words = pseudonym_words() + ".";
    words.front() = 'A';
    return words;
  }
  if (std::find(model.taken.begin(), model.taken.end(), participant) != model.taken.end()) {
    return tr("{} has taken part already.", participant);
  }
  return "";
}

/// Why the words about the device's fitting cannot be stored; "" if they can.
std::string fitting_problem(const PrepareViewState& state) {
  if (is_fitting(state.fitting)) return "";
  return tr("Fitting: write glove=M, thumb=thin pad. Keys in small letters, each once.");
}

/// Why the session cannot start; "" if it can.
std::string obstacle(const PrepareModel& model, const PrepareViewState& state) {
  std::string participant = participant_problem(model, state.participant);
  if (!participant.empty()) return participant;
  for (const experiments::ParticipantField& field : model.fields) {
    if (!state.fields.contains(field.name)) {
      return tr("Choose first: {}",
                in_language(field.question, shown_language(model.languages)));
    }
  }
  if (std::string fitting = fitting_problem(state); !fitting.empty()) return fitting;
  if (std::string sound = sound_obstacle(model.sound); !sound.empty()) return sound;
  std::string failed;
  for (const PreflightLine& line : model.lines) {
    if (line.status == Status::kFailed) failed += (failed.empty() ? "" : ", ") + line.name;
  }
  if (!failed.empty()) return tr("To be mended first: {}.", failed);
  const bool waits = std::any_of(model.lines.begin(), model.lines.end(), [](const auto& line) {
    return line.status == Status::kWaiting;
  });
  return model.looking || waits || model.lines.empty() ? tr("Still looking at the machine.")
                                                       : "";
}

/// The words below the field: what is wrong with the pseudonym, or which order it gets.
std::pair<std::string, Colour> words_of_participant(const PrepareModel& model,
                                                    const PrepareViewState& state) {
  std::string problem = participant_problem(model, state.participant);
  if (!problem.empty()) return {std::move(problem), Colour::kRed};
  const std::string like = lookalike(state.participant, model.taken);
  if (!like.empty()) {
    return {tr("Another person than {}, who has taken part?", like), Colour::kPilot};
  }
  return {model.study.hides_levels ? std::string(tr("Order assigned, but hidden."))
          : state.fields.size() < model.fields.size() ? tr("Order: as chosen below.")
          : model.assigned.empty()                    ? tr("The same order for everyone.")
                                                      : tr("Order: {}.", model.assigned),
          Colour::kSoft};
}

void draw_participant(Ui& ui, Rect& inside, const PrepareModel& model, PrepareViewState& state,
                      bool& entered) {
  ui.heading(inside.take_top(18, 6), tr("Participant"));
  entered =
      ui.text_field("participant", inside.take_top(46, 6), state.participant, tr("pseudonym"));
  const auto [words, colour] = words_of_participant(model, state);
  ui.text(inside, words, {.font = Font::kSmall, .colour = colour, .wrap = true});
}

bool is_simulated(const PrepareModel& model, const PrepareViewState& state) {
  const auto device =
      std::ranges::find(model.devices, state.device, &PrepareModel::Device::name);
  return device != model.devices.end() && device->simulated;
}

const char* words_of_kind(const PrepareModel& model, const PrepareViewState& state) {
  return state.pilot ? tr("Marked for good, left out of results.")
         : is_simulated(model, state)
             ? tr("Its answers are data, though the device is simulated.")
             : tr("Its answers are data.");
}

void draw_kind(Ui& ui, Rect& inside, const PrepareModel& model, PrepareViewState& state) {
  ui.heading(inside.take_top(18, 6), tr("Kind of session"));
  Rect line = inside.take_top(46, 6);
  const float half = std::min(220.0f, (line.width - 12) / 2);
  if (ui.button("real_session", line.take_left(half, 12), tr("Real"),
                {.key = {letter('R')}, .selected = !state.pilot})) {
    state.pilot = false;
    state.kind_is_chosen = true;
  }
  if (ui.button("pilot_session", line.take_left(half), tr("Pilot"),
                {.key = {letter('P')}, .selected = state.pilot})) {
    state.pilot = true;
    state.kind_is_chosen = true;
  }
  const bool is_odd = !state.pilot && is_simulated(model, state);
  ui.text(inside, words_of_kind(model, state),
          {.font = Font::kSmall,
           .colour = state.pilot ? Colour::kPilot
                     : is_odd    ? Colour::kAmber
                                 : Colour::kSoft,
           .wrap = true});
}

void draw_devices(Ui& ui, Rect& inside, const PrepareModel& model, PrepareViewState& state,
                  PrepareViewResult& result) {
  ui.heading(inside.take_top(18, 6), tr("Device"));
  constexpr float kRow = 54;
  for (std::size_t i = 0; i < model.devices.size(); ++i) {
    const PrepareModel::Device& device = model.devices[i];
    const Chord key = i < 9 ? Chord{letter(static_cast<char>('1' + i))} : Chord{};
    const Rect row = inside.take_top(kRow, 4);
    const bool selected = device.name == state.device;
    if (selected) ui.fill(row, Colour::kBlueSoft, 8);
    ui.outline(row, selected ? Colour::kBlue : Colour::kLine, 8);
    if (ui.row("device_" + device.name, row, device.name, key) && !selected) {
      state.device = device.name;
      choose_kind(model, state);
      result.look_again = true;
    }
    Rect words = row.inset(6);
    words.take_left(10);
    if (key.key != Key::kNone) {
      const Rect cap = words.take_right(ui.key_cap_width(key), 12);
      ui.key_cap(cap.x, cap.y + (cap.height - 20) / 2, key);
    }
    ui.text(words.take_top(22), device.name + (device.simulated ? tr(" · simulated") : ""),
            {.font = Font::kStrong,
             .colour = selected ? Colour::kBlue : Colour::kInk,
             .any_length = true});
    ui.text(words, device.description,
            {.font = Font::kSmall, .colour = Colour::kSoft, .any_length = true});
  }
  inside.take_top(16);
}

/// Draws the languages side by side. The key chooses the next one.
void draw_languages(Ui& ui, Rect& inside, const PrepareModel& model, PrepareViewState& state) {
  ui.heading(inside.take_top(18, 6), tr("Language of the participant"));
  Rect line = inside.take_top(42, 20);
  const auto now = std::find(model.languages.begin(), model.languages.end(), state.language);
  const auto current = static_cast<std::size_t>(now - model.languages.begin());
  for (std::size_t i = 0; i < model.languages.size(); ++i) {
    const bool is_next =
        model.languages.size() > 1 && i == (current + 1) % model.languages.size();
    const ButtonStyle style{.key = is_next ? Chord{letter('L')} : Chord{},
                            .selected = i == current};
    const float width = std::max(90.0f, ui.button_width(model.languages[i], style));
    if (ui.button("language_" + model.languages[i], line.take_left(width, 10),
                  model.languages[i], style)) {
      state.language = model.languages[i];
    }
  }
}

/// Draws a line of answers to each question about the participant. The key chooses the next
/// answer to the first question that has none.
void draw_fields(Ui& ui, Rect& inside, const PrepareModel& model, PrepareViewState& state,
                 PrepareViewResult& result) {
  const std::string& language = shown_language(model.languages);
  const auto open =
      std::find_if(model.fields.begin(), model.fields.end(),
                   [&](const auto& one) { return !state.fields.contains(one.name); });
  for (std::size_t i = 0; i < model.fields.size(); ++i) {
    const experiments::ParticipantField& field = model.fields[i];
    ui.heading(inside.take_top(18, 6), in_language(field.question, language), "", Align::kLeft,
               /*any_length=*/true);
    Flow answers(inside, 42, 10);
    const bool has_key =
        open == model.fields.end() ? i + 1 == model.fields.size() : field.name == open->name;
    const auto chosen =
        std::find_if(field.options.begin(), field.options.end(), [&](const auto& option) {
          const auto value = state.fields.find(field.name);
          return value != state.fields.end() && value->second == option.value;
        });
    const bool is_chosen = chosen != field.options.end();
    const auto next =
        is_chosen && chosen + 1 != field.options.end() ? chosen + 1 : field.options.begin();
    for (auto option = field.options.begin(); option != field.options.end(); ++option) {
      const ButtonStyle style{.key = has_key && option == next ? Chord{letter('F')} : Chord{},
                              .selected = option == chosen};
      const std::string& label = in_language(option->label, language);
      const float width = std::max(90.0f, ui.button_width(label, style));
      if (ui.button("field_" + field.name + '_' + option->value, answers.next(width), label,
                    style)) {
        state.fields[field.name] = option->value;
        result.fields_changed = true;
      }
    }
    inside.take_top(answers.height(), 20);
  }
}

/// Asks how the device is fitted to this person, in words of whoever fits it.
void draw_fitting(Ui& ui, Rect& inside, PrepareViewState& state) {
  ui.heading(inside.take_top(18, 6), tr("How the device was fitted"));
  (void)ui.text_field("fitting", inside.take_top(46, 6), state.fitting,
                      tr("glove=M, thumb=thin pad; may be left empty"));
  const std::string problem = fitting_problem(state);
  const std::string words =
      problem.empty() ? std::string(tr("Kept with the session, and with the points held."))
                      : problem;
  const TextStyle style{.font = Font::kSmall,
                        .colour = problem.empty() ? Colour::kSoft : Colour::kRed,
                        .wrap = true};
  const float height = std::max(20.0f, ui.text_height(inside.width, words, style));
  ui.text(inside.take_top(height, 16), words, style);
}

void draw_seed(Ui& ui, Rect place, const PrepareModel& model) {
  ui.heading(place.take_top(18, 6), tr("Seed of every order"));
  // Whoever knows the seed can draw the orders elsewhere.
  const bool hidden = model.study.hides_levels;
  ui.text(place.take_top(42), hidden ? tr("drawn, but hidden") : std::to_string(model.seed),
          {.font = hidden ? Font::kBody : Font::kMono, .colour = Colour::kSoft});
}

/// Draws the line's name, what was found, and what would remedy it.
void draw_line(Ui& ui, Rect& inside, const PreflightLine& line, bool is_next) {
  const TextStyle remedy{.font = Font::kSmall, .colour = Colour::kSoft, .wrap = true};
  const float text_width = inside.width - 22;
  const float remedy_height =
      line.remedy.empty() ? 0 : ui.text_height(text_width, line.remedy, remedy) + 4;
  const TextStyle found{.colour = colour_of(line.status), .align = Align::kRight};
  const Rect whole = inside.take_top(40 + remedy_height);
  Rect words = whole;
  const float middle = words.y + 20;
  if (line.status == Status::kWaiting) {
    ui.ring(words.x + 6, middle, 5, Colour::kSoft);
  } else if (line.status == Status::kOk) {
    ui.check(words.x + 6, middle, 13, Colour::kGreen);
  } else {
    ui.dot(words.x + 6, middle, 5, colour_of(line.status));
  }
  words.take_left(22);
  const std::string waiting = is_next ? tr("looking …") : "";
  draw_name_and_value(ui, words.take_top(40), line.name, {},
                      line.status == Status::kWaiting ? waiting : line.found, found);
  if (!line.remedy.empty()) ui.text(words, line.remedy, remedy);
  ui.line(whole.x, whole.bottom(), whole.right(), whole.bottom(), Colour::kLine);
}

void draw_lines(Ui& ui, const Rect& place, const PrepareModel& model, PrepareViewState& state,
                PrepareViewResult& result) {
  Rect inside = draw_card(ui, place, tr("Is everything ready?"));
  Rect bottom = inside.take_bottom(46, 12);
  ButtonStyle style{.key = {.key = letter('L'), .control = true}, .enabled = !model.looking};
  ButtonStyle map{.key = {Key::kF7}};
  constexpr float kProgress = 60;
  const float wanted = ui.button_width(tr("Look again"), style) + 40 + kProgress +
                       ui.button_width(tr("Pedals and buttons"), map);
  style.hides_key = map.hides_key = wanted > bottom.width;
  if (ui.button("look_again", bottom.take_right(ui.button_width(tr("Look again"), style), 20),
                tr("Look again"), style)) {
    result.look_again = true;
  }
  if (ui.button("map_controls",
                bottom.take_left(ui.button_width(tr("Pedals and buttons"), map), 20),
                tr("Pedals and buttons"), map)) {
    result.map_controls = true;
  }
  if (model.looking && bottom.width > 0) {
    ui.progress(bottom.middle(bottom.width, 8), model.progress);
  }
  Rect lines = ui.begin_scroll("lines", inside, state.lines_height);
  const float top = lines.y;
  bool waited = false;
  for (const PreflightLine& line : model.lines) {
    const bool waits = line.status == Status::kWaiting;
    draw_line(ui, lines, line, model.looking && waits && !waited);
    waited |= waits;
  }
  state.lines_height = lines.y - top;
  ui.end_scroll();
}

}  // namespace

void choose_kind(const PrepareModel& model, PrepareViewState& state) {
  if (!state.kind_is_chosen) state.pilot = is_simulated(model, state);
}

PrepareViewResult draw_prepare_view(Ui& ui, const PrepareModel& model,
                                    PrepareViewState& state) {
  PrepareViewResult result;
  Rect rest = ui.screen();
  result.tab =
      draw_study_header(ui, rest.take_top(kHeaderHeight), model.study, StudyTab::kNone).chosen;
  const Rect footer = rest.take_bottom(kFooterHeight);
  rest = rest.inset(kGap);
  Rect bar = rest.take_bottom(88, kGap);
  const Rect left = rest.take_left((rest.width - kGap) / 2, kGap);
  Rect inside = draw_card(ui, left, "");
  bool entered = false;
  inside = ui.begin_scroll("session", inside, state.session_height);
  const float top = inside.y;
  ui.text(inside.take_top(40, 14), tr("Prepare a session"), {.font = Font::kTitle});
  const float of_who = (inside.width - 24) * 0.44f;
  const TextStyle small{.font = Font::kSmall, .wrap = true};
  const float below = std::max(
      {38.0f, ui.text_height(of_who, words_of_participant(model, state).first, small),
       ui.text_height(inside.width - 24 - of_who, words_of_kind(model, state), small)});
  Rect pair = inside.take_top(18 + 6 + 46 + 6 + below, 12);
  Rect who = pair.take_left(of_who, 24);
  draw_participant(ui, who, model, state, entered);
  draw_kind(ui, pair, model, state);
  // The two are side by side if their headings have room.
  const float of_seed = std::min(300.0f, inside.width / 2);
  const bool is_beside =
      ui.text_width(tr("Seed of every order"), Font::kSmallStrong) <= of_seed &&
      ui.text_width(tr("Language of the participant"), Font::kSmallStrong) <=
          inside.width - of_seed - 16;
  Rect both = inside.take_top(is_beside ? 70 : 2 * 70 + 12, 12);
  draw_seed(ui, is_beside ? both.take_right(of_seed, 16) : both.take_bottom(70, 12), model);
  draw_languages(ui, both, model, state);
  draw_fields(ui, inside, model, state, result);
  // The sound is above the list of devices, because that is long and whoever prepares a session
  // must see the sound.
  result.sound = draw_sound_card(ui, inside, model.sound, state.sound_output);
  draw_devices(ui, inside, model, state, result);
  draw_fitting(ui, inside, state);
  state.session_height = inside.y - top;
  ui.end_scroll();
  draw_lines(ui, rest, model, state, result);

  ui.card(bar);
  bar = bar.inset(14);
  const std::string why_not = obstacle(model, state);
  const ButtonStyle start{
      .tone = Tone::kPrimary, .key = {Key::kEnter}, .enabled = why_not.empty(), .large = true};
  const float width = std::max(320.0f, ui.button_width(tr("Start session"), start));
  const Rect button = bar.take_right(width, 20);
  if (ui.button("start_session", button, tr("Start session"), start) ||
      (entered && why_not.empty())) {
    result.start = true;
  }
  bar.take_left(4);
  ui.text(bar,
          !why_not.empty() ? why_not
          : state.pilot    ? tr("{}, pilot, with {}.", state.participant, state.device)
                           : tr("{}, with {}.", state.participant, state.device),
          {.font = Font::kLarge,
           .colour = why_not.empty() ? Colour::kInk : Colour::kSoft,
           .any_length = why_not.empty()});
  draw_study_footer(ui, footer, tr("Nothing is stored before the session starts."), "");
  return result;
}

}  // namespace jnd::app::gui
