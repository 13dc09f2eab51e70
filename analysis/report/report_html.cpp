#include <set>

#include "analysis/report/figures.h"
#include "analysis/report/html_text.h"
#include "analysis/report/report.h"
#include "analysis/report/report_contrasts.h"
#include "analysis/report/report_methods.h"
#include "analysis/report/report_published.h"
#include "analysis/report/report_results.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

std::vector<core::SessionRow> analysed_sessions(const ReportSource& source) {
  std::vector<core::SessionRow> sessions;
  for (const core::SessionRow& session : source.store.sessions()) {
    if (!session.pilot || source.pilot) sessions.push_back(session);
  }
  return sessions;
}

/// Whether the report has a figure of this section. It shows what was asked, and not how people
/// moved, how fast they answered or what they said.
bool is_in_report(const std::string& section) {
  return section.empty() || (section != "movement" && section != "response_times" &&
                             section != "questionnaires" && !section.ends_with("_questions"));
}

/// Puts figures into their sections, each once, and lists them at the end.
class FigureChapters {
 public:
  FigureChapters(HtmlText& html, const std::vector<Figure>& figures,
                 const std::vector<DrawnFigure>& drawn, const StudyResults& results)
      : html_(html),
        figures_(figures),
        drawn_(drawn),
        simulated_(results.simulated),
        of_thesis_(is_of_thesis(results)),
        numbers_(figures.size(), 0) {}

  /// Writes the first figure of this section of the results.
  void write_first(const std::string& section) {
    for (std::size_t i = 0; i < figures_.size(); ++i) {
      if (figures_[i].section == section) return write(i);
    }
  }

  /// Writes the figures of this section of the results, without the first one if the report
  /// shows it. The section "" holds the figures that belong to no other one.
  void write_others_of(const std::string& section) {
    bool is_first = true;
    for (std::size_t i = 0; i < figures_.size(); ++i) {
      if (numbers_[i] != 0 || figures_[i].section != section) continue;
      if (is_first && is_in_report(section)) {
        is_first = false;
        in_report_.insert(i);
        continue;
      }
      write(i);
    }
  }

  void write_others() {
    bool any = false;
    for (std::size_t i = 0; i < figures_.size(); ++i) {
      if (numbers_[i] != 0 || in_report_.contains(i)) continue;
      if (!any) html_.heading(3, said("Further figures"));
      any = true;
      write(i);
    }
  }

  void write_list() {
    if (figures_.empty()) return;
    html_.heading(2, said("Files of the figures"));
    html_.paragraph(said(
        "Beside this report, in the folder figures, each figure lies as NAME.svg and NAME.pdf "
        "with the gnuplot script that draws it, NAME.gp, and the tables it is drawn from."));
    HtmlTable table{
        .caption = of_thesis_
                       ? said("Figures, those of Schmidt (2018) that they answer, and files")
                       : said("Figures and files"),
        .columns = {{said("Figure"), true}, {said("Title")}}};
    if (of_thesis_) table.columns.push_back({"Schmidt (2018)"});
    table.columns.push_back({said("Name"), false, true});
    for (std::size_t i = 0; i < figures_.size(); ++i) {
      const Figure& figure = figures_[i];
      auto& row = table.rows.emplace_back();
      row = {numbers_[i] == 0 ? "report" : "S" + std::to_string(numbers_[i]), figure.title};
      if (of_thesis_) row.push_back(figure.thesis.empty() ? "–" : figure.thesis);
      row.push_back(figure.name);
    }
    html_.table(table);
  }

 private:
  void write(std::size_t i) {
    const Figure& figure = figures_[i];
    std::string caption = figure.caption;
    if (of_thesis_ && !figure.thesis.empty()) {
      caption += " Schmidt (2018): " + figure.thesis + ".";
    }
    if (simulated_) caption += said(" SIMULATED data.");
    if (drawn_[i].svg.empty()) caption += said(" Not drawn: {}.", said_of(drawn_[i].problem));
    numbers_[i] = html_.figure(figure.name, drawn_[i].svg, figure.title, caption);
  }

  HtmlText& html_;
  const std::vector<Figure>& figures_;
  const std::vector<DrawnFigure>& drawn_;
  bool simulated_;
  bool of_thesis_;  ///< See `is_of_thesis`.
  /// The number of each figure in this document; 0 for figures that are not yet written.
  std::vector<int> numbers_;
  std::set<std::size_t> in_report_;
};

std::string contents(const HtmlText& html) {
  std::string text = "<nav><ul>\n";
  for (const auto& [id, title] : html.sections()) {
    text += "<li><a href=\"#" + id + "\">" + html_escaped(title) + "</a></li>\n";
  }
  return text + "</ul></nav>\n";
}

/// The front of a document. `what` is its kind, such as "Report on".
std::string front(const ReportSource& source, const std::string& title,
                  const std::string& what) {
  std::string text = "<h1>" + html_escaped(title) + "</h1>\n<p class=\"authors\">";
  std::string authors;
  for (const std::string& author : source.data.written.authors) {
    authors += (authors.empty() ? said("Study by ") : ", ") + author;
  }
  if (!authors.empty()) authors += ". ";
  authors += said("{} “{}”, {}.", what, source.data.study,
                  counted_words(std::ssize(source.data.participants), "participant"));
  text += html_escaped(authors) + "</p>\n";
  if (source.results.simulated) {
    text += "<p class=\"banner\">" +
            html_escaped(said("SIMULATED data: participants and apparatus are those of the "
                              "laboratory “{}”. No person felt or judged anything here.",
                              source.results.laboratory)) +
            "</p>\n";
  }
  if (source.pilot) {
    text += "<p class=\"banner\">" +
            html_escaped(said("PILOT sessions are among these data.")) + "</p>\n";
  }
  return text;
}

std::string whole_document(const ReportSource& source, const std::string& title,
                           const std::string& what, const HtmlText& html) {
  const std::string mark = source.results.simulated ? said("SIMULATED data")
                           : source.pilot           ? said("PILOT data")
                                                    : "";
  return html_document(title, mark, front(source, title, what) + contents(html) + html.text());
}

}  // namespace

std::string report_html(const ReportSource& source, const std::vector<Figure>& figures,
                        const std::vector<DrawnFigure>& drawn) {
  const StudyTitles titles = titles_of(source.data.written);
  const std::vector<core::SessionRow> sessions = analysed_sessions(source);
  const std::vector<SessionQuality> quality = session_quality(source.store, sessions);
  const ChapterSource chapters{source, titles, sessions, quality};
  HtmlText html;
  FigureChapters figure_chapters(html, figures, drawn, source.results);
  write_at_a_glance(html, source.results, titles);
  write_deviations(html, source.results);
  if (source.delivered != nullptr) {
    write_delivered(html, source.results, *source.delivered, titles);
    figure_chapters.write_first("delivered");
  }
  html.heading(2, said("Results"));
  write_contrasts(html, source.results);
  for (const ResultsSection& section : source.results.sections) {
    if (is_in_report(section.name)) figure_chapters.write_first(section.name);
  }
  figure_chapters.write_first("");
  html.paragraph(said("Every other estimate, comparison and figure, everybody’s own values and "
                      "what was left out and why are in the supplement."),
                 "note");
  write_participants_in_short(html, chapters);
  write_data_quality_in_short(html, chapters);
  write_methods(html, chapters);
  write_references(html, chapters);
  return whole_document(source, titles.study, said("Report on"), html);
}

std::string supplement_html(const ReportSource& source, const std::vector<Figure>& figures,
                            const std::vector<DrawnFigure>& drawn) {
  const StudyTitles titles = titles_of(source.data.written);
  const std::vector<core::SessionRow> sessions = analysed_sessions(source);
  const std::vector<SessionQuality> quality = session_quality(source.store, sessions);
  const ChapterSource chapters{source, titles, sessions, quality};
  HtmlText html("S");
  FigureChapters figure_chapters(html, figures, drawn, source.results);
  write_participants(html, chapters);
  write_data_quality(html, chapters);
  html.heading(2, said("Results"));
  for (const ResultsSection& section : source.results.sections) {
    html.heading(3, section_title(titles, section.name));
    write_section(html, source.data, source.results, titles, section);
    if (section.name == "movement") write_movement(html, source, titles);
    figure_chapters.write_others_of(section.name);
  }
  const HtmlTable published = published_table(source.results, titles);
  if (!published.rows.empty()) {
    html.heading(2, said("Published values"));
    html.table(published);
  }
  figure_chapters.write_others_of("");
  figure_chapters.write_others_of("delivered");
  figure_chapters.write_others();
  figure_chapters.write_list();
  write_provenance(html, chapters);
  return whole_document(source, titles.study, said("Supplement to the report on"), html);
}

}  // namespace jnd::analysis
