#include "app/regress/regress_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/process/html_text.hpp"
#include "framework/base/console.hpp"
#include "framework/base/json.hpp"
#include "framework/base/utc_time.hpp"

namespace sluice {
namespace {

const RegressCheck* check_named(const RegressResult& r, const std::string& name) {
  const auto found = std::find_if(r.checks.begin(), r.checks.end(),
                                  [&](const RegressCheck& c) { return c.name == name; });
  return found == r.checks.end() ? nullptr : &*found;
}

const char* css_class(CaseVerdict v) {
  switch (v) {
    case CaseVerdict::same:
    case CaseVerdict::blessed:
      return "good";
    case CaseVerdict::different:
      return "moved";
    case CaseVerdict::invalid:
      return "invalid";
    default:
      return "none";
  }
}

// Of the largest magnitude, where that is known; else of the larger of both.
double relative_change(const Moved& m) {
  const double scale =
      m.largest > 0 ? m.largest : std::max(std::fabs(m.before), std::fabs(m.after));
  return scale > 0 ? std::fabs(m.after - m.before) / scale : 0;
}

std::string table_of_moved(const RegressCheck& check) {
  if (check.moved.empty()) return {};
  std::string text =
      "<table><tr><th>label<th>where<th>t<th>before<th>after<th>change<th>relative</tr>\n";
  for (const Moved& m : check.moved)
    text += fmt::format(
        "<tr><td>{}<td>{}<td class=n>{:g}<td class=n>{:.10g}<td class=n>{:.10g}<td class=n>{:.3g}"
        "<td class=n>{}</tr>\n",
        html_text(m.label), html_text(m.where), m.time, m.before, m.after, m.after - m.before,
        human_percent(relative_change(m)));
  return text + "</table>\n";
}

std::string summary_table(const std::vector<RegressResult>& results) {
  const std::vector<std::string> names = check_names(results);
  std::string text = "<table><tr><th>case";
  for (const std::string& name : names) text += "<th>" + html_text(name);
  text += "<th>time</tr>\n";
  for (const RegressResult& r : results) {
    text += fmt::format("<tr><td><a href=\"#{0}\">{0}</a>", html_text(r.name));
    for (const std::string& name : names) {
      const RegressCheck* check = check_named(r, name);
      text += check == nullptr ? std::string("<td class=none>-")
                               : fmt::format("<td class={}>{}", css_class(check->verdict),
                                             to_string(check->verdict));
    }
    text += fmt::format("<td class=n>{}</tr>\n", human_duration(r.seconds));
  }
  return text + "</table>\n";
}

constexpr const char* page_style = R"(
body{font:14px/1.4 sans-serif;margin:2em;max-width:80em} table{border-collapse:collapse}
td,th{border:1px solid #bbb;padding:.2em .6em;text-align:left} .n{text-align:right}
.good{background:#d8f0d8} .moved{background:#f8dcc0} .invalid{background:#f0c0c0} .none{color:#888}
)";

}  // namespace

std::vector<std::string> check_names(const std::vector<RegressResult>& results) {
  std::vector<std::string> names;
  for (const RegressResult& r : results)
    for (const RegressCheck& c : r.checks)
      if (std::find(names.begin(), names.end(), c.name) == names.end()) names.push_back(c.name);
  return names;
}

std::string regress_page(const std::vector<RegressResult>& results) {
  const auto good = std::count_if(results.begin(), results.end(),
                                  [](const RegressResult& r) { return r.status() == 0; });
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>sluice "
      "regress</title><style>{}</style></head><body>\n<h1>Regression of {} case{}</h1>\n<p>{} of "
      "{} are as the gold; {}</p>\n{}",
      page_style, results.size(), results.size() == 1 ? "" : "s", good, results.size(), utc_now(),
      summary_table(results));
  for (const RegressResult& r : results) {
    text += fmt::format("<h2 id=\"{0}\">{0}</h2>\n", html_text(r.name));
    for (const RegressCheck& c : r.checks) {
      if (c.message.empty() && c.moved.empty()) continue;
      text += fmt::format("<h3>{}: {}</h3>\n<p>{}</p>\n{}", html_text(c.name), to_string(c.verdict),
                          html_text(c.message), table_of_moved(c));
    }
  }
  return text + "</body></html>\n";
}

Json regress_json(const std::vector<RegressResult>& results) {
  Json list = Json::array();
  for (const RegressResult& r : results) {
    Json checks = Json::object();
    for (const RegressCheck& c : r.checks) {
      Json moved = Json::array();
      for (const Moved& m : c.moved)
        moved.push_back({{"label", m.label},
                         {"where", m.where},
                         {"time", m.time},
                         {"before", m.before},
                         {"after", m.after},
                         {"change", m.after - m.before},
                         {"relative", relative_change(m)}});
      checks[c.name] = {
          {"verdict", to_string(c.verdict)}, {"message", c.message}, {"moved", moved}};
    }
    list.push_back(
        {{"name", r.name}, {"good", r.status() == 0}, {"seconds", r.seconds}, {"checks", checks}});
  }
  return {{"cases", list}};
}

}  // namespace sluice
