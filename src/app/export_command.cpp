// sluice export UDA: files that ParaView and VisIt open.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.hpp"
#include "framework/archive/vtk_export.hpp"

namespace sluice {
namespace {

struct ExportRequest {
  std::string archive, folder, only, ignore;
  ExportOptions options;
};

void export_archive(ExportRequest& r) {
  r.options.labels = {split_names(r.only), split_names(r.ignore)};
  const Archive archive = Archive::open(r.archive);
  const std::string folder =
      r.folder.empty() ? archive.folder().filename().string() + ".vtk" : r.folder;
  fmt::print("{}\n", export_vtk(archive, folder, r.options).string());
}

}  // namespace

void add_export_command(CLI::App& app, int&) {
  CLI::App* command =
      app.add_subcommand("export", "Write .pvd, .vti, .vtm and .vthb files for ParaView and VisIt");
  auto r = std::make_shared<ExportRequest>();
  command->add_option("UDA", r->archive, "The archive")->required();
  command->add_option("-o,--output", r->folder, "Folder to write into; NAME.uda.NNN.vtk");
  command->add_option("--vars", r->only, "Only these labels: a,b,c");
  command->add_option("--ignore", r->ignore, "All labels but these: a,b,c");
  command->add_option("--time", r->options.time, "One output: last, first, a time, #N; else all");
  command->callback([r] { export_archive(*r); });
}

}  // namespace sluice
