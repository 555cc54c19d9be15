#include "app/report/run_page.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "app/loading/scene_loader.hpp"
#include "app/plan/run_plan.hpp"
#include "app/process/html_text.hpp"
#include "app/report/report_numbers.hpp"
#include "app/report/report_pictures.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr const char* page_style = R"(
body{font:15px/1.45 sans-serif;margin:0 auto;padding:1em 2em;max-width:76em;color:#222}
h1{font-size:1.5em} h2{border-bottom:2px solid #446;margin-top:1.6em} h3{margin-bottom:.3em}
table{border-collapse:collapse;margin:.4em 0} th{background:#eef}
td,th{border:1px solid #bbc;padding:.15em .6em;text-align:left} .n{text-align:right}
pre{background:#f4f4f8;padding:.8em;overflow:auto;font-size:12px;max-height:40em}
img{max-width:100%;border:1px solid #ccd} figure{margin:1em 0} figcaption{color:#555}
nav a{margin-right:1em} .missing{color:#a33}
)";

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What `sluice plan` says of the deck of the run; a note where it cannot.
std::string plan_of(const fs::path& deck, int ranks, int threads, std::vector<std::string>& notes) {
  try {
    const auto loaded = load_scene(deck.string(), {}, {}, Warnings::hidden);
    PlanOptions options;
    options.ranks = std::max(ranks, 1);
    options.threads = std::max(threads, 1);
    return plan_text(plan_run(*loaded, options));
  } catch (const Error& error) {
    notes.push_back(fmt::format("no plan: {}", error.what()));
    return "";
  }
}

// The sections of a page, with the links to them.
class Sections {
 public:
  void add(const char* id, const char* title, const std::string& html) {
    if (html.empty()) return;
    links_ += fmt::format("<a href=\"#{}\">{}</a>", id, title);
    body_ += fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, title, html);
  }
  std::string text() const { return fmt::format("<nav>{}</nav>\n{}", links_, body_); }

 private:
  std::string links_, body_;
};

std::string pictures_html(const std::vector<ReportPicture>& pictures, RunPage& page) {
  std::string html;
  for (const ReportPicture& p : pictures) {
    if (p.png.empty()) {
      html += fmt::format("<p class=missing>{} could not be drawn: {}</p>\n", html_text(p.title),
                          html_text(p.fault));
      page.notes.push_back(fmt::format("{} could not be drawn: {}", p.title, p.fault));
      continue;
    }
    ++page.pictures;
    html += fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption>"
        "</figure>\n",
        html_text(p.title), base64(p.png));
  }
  return html;
}

std::string preformatted(const std::string& text) {
  return text.empty() ? "" : "<pre>" + html_text(text) + "</pre>\n";
}

}  // namespace

RunPage run_page(const RunPageOptions& options) {
  const Archive archive = Archive::open(options.archive);
  const Json run = Json::parse_or_null(text_of(archive.folder() / "run.json"));
  RunPage page;
  if (!run.is_object())
    page.notes.push_back("no run.json: the page has no times, events and conservation");
  const fs::path deck = archive.folder() / "input.xml";
  const auto whole = [&](const char* name) {
    return run.is_object() ? static_cast<int>(run.value(name, std::int64_t{1})) : 1;
  };
  const std::string title =
      options.title.empty() ? archive.folder().filename().string() : options.title;
  Sections sections;
  sections.add("summary", "Summary", report_summary(archive, run));
  if (options.pictures)
    sections.add("pictures", "Pictures",
                 pictures_html(field_pictures(archive, options.labels), page));
  sections.add("conservation", "Conservation", report_conservation(run));
  sections.add("events", "Events", report_events(run));
  sections.add("times", "Time", report_times(run));
  sections.add("outputs", "Outputs", report_outputs(archive));
  if (options.pictures)
    sections.add("histories", "Histories", pictures_html(history_pictures(archive), page));
  const std::string plan = plan_of(deck, whole("ranks"), whole("threads"), page.notes);
  sections.add("plan", "Plan", preformatted(plan));
  sections.add("deck", "Deck", preformatted(text_of(deck)));
  page.html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title><style>"
      "{1}</style></head><body>\n<h1>{0}</h1>\n{2}</body></html>\n",
      html_text(title), page_style, sections.text());
  return page;
}

}  // namespace sluice
