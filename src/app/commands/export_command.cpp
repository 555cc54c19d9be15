// sluice export UDA: files that ParaView and VisIt open.
#include <fmt/format.h>

#include <memory>

#include "app/command/command_line.hpp"
#include "framework/archive/uda/raw_export.hpp"
#include "framework/archive/vtk/vtk_export.hpp"
#include "framework/archive/xdmf/xdmf_link.hpp"

namespace sluice {
namespace {

struct ExportRequest {
  std::string archive, folder, only, ignore, format = "vtk";
  ExportOptions options;
  bool link = false;
};

void link_archive(const ExportRequest& r) {
  if (!r.folder.empty() || !r.only.empty() || !r.ignore.empty() || !r.options.time.empty() ||
      r.options.amr || r.format != "vtk")
    throw InputError(
        "--link shows all of an archive where it lies; leave out -o, --vars, --ignore, --time, "
        "--amr and --format");
  fmt::print("{}\n", write_xdmf_link(Archive::open(r.archive)).string());
}

void export_archive(ExportRequest& r) {
  if (r.link) return link_archive(r);
  if (r.options.amr && r.format != "vtk")
    throw InputError("--amr is for files of VTK; leave out --format " + r.format);
  r.options.labels = {split_names(r.only), split_names(r.ignore)};
  const Archive archive = Archive::open(r.archive);
  const std::string name = archive.folder().filename().string();
  const std::string folder = r.folder.empty() ? name + "." + r.format : r.folder;
  const auto written = r.format == "uda"
                           ? export_raw(archive, folder, r.options.labels, r.options.time)
                           : export_vtk(archive, folder, r.options);
  fmt::print("{}\n", written.string());
}

}  // namespace

void declare_export_command(Command& command) {
  auto r = std::make_shared<ExportRequest>();
  command.option("UDA", r->archive, "The archive").required();
  command
      .option("--format", r->format,
              "vtk: .pvd, .vti, .vtm and .vtp files for ParaView and VisIt; uda: Uintah's raw "
              "layout, for programs that read that")
      .one_of({"vtk", "uda"});
  command.option("-o,--output", r->folder, "Folder to write into; NAME.uda.NNN.vtk or .uda");
  command.option("--vars", r->only, "Only these labels: a,b,c");
  command.option("--ignore", r->ignore, "All labels but these: a,b,c");
  command.option("--time", r->options.time,
                 "Only this output: last, first, a time, #N; absent: all outputs");
  command.flag("--amr", r->options.amr,
               "Several levels as AMR data sets (.vthb), for filters that know these");
  command.flag("--link", r->link,
               "No copy: writes fields.xmf into the archive, which ParaView's XDMF Reader opens; "
               "runs write it at their end");
  command.action([r] {
    export_archive(*r);
    return 0;
  });
}

}  // namespace sluice
