// sluice report UDA: one HTML page of a run.
#include <fmt/format.h>

#include <memory>

#include "app/command/command_line.hpp"
#include "app/process/text_sink.hpp"
#include "app/report/run_page.hpp"
#include "framework/archive/selection.hpp"
#include "framework/base/console.hpp"

namespace sluice {
namespace {

struct ReportRequest {
  RunPageOptions page;
  std::string output = "report.html", labels;
  bool no_pictures = false;
};

int report(ReportRequest& r) {
  r.page.labels = split_names(r.labels);
  r.page.pictures = !r.no_pictures;
  const RunPage page = run_page(r.page);
  write_text(r.output, page.html);
  for (const std::string& note : page.notes) fmt::print(stderr, "sluice report: note: {}\n", note);
  if (r.output != "-")
    fmt::print("{}: {} pictures, {}\n", r.output, page.pictures,
               human_bytes(static_cast<double>(page.html.size())));
  return 0;
}

}  // namespace

void declare_report_command(Command& command) {
  auto r = std::make_shared<ReportRequest>();
  command.option("UDA", r->page.archive, "The archive").required();
  command.option("-o,--output", r->output, "The page, - for standard output (report.html)");
  command.option("--var", r->labels,
                 "Labels to draw, a,b,c; absent: those that sluice plot draws by itself");
  command.option("--title", r->page.title, "Title of the page; absent: the name of the archive");
  command.flag("--no-pictures", r->no_pictures, "Leave out pictures (of fields and histories)");
  command.action([r] { return report(*r); });
}

}  // namespace sluice
