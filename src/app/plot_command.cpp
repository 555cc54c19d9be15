// sluice plot UDA: pictures of an archive.
#include <CLI/CLI.hpp>
#include <memory>

#include "app/archive_picture.hpp"
#include "app/commands.hpp"

namespace sluice {

void add_plot_command(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("plot", "Draw an archive: profiles, slices, histories");
  auto request = std::make_shared<PictureRequest>();
  command->add_option("UDA", request->archive, "Archive (folder or link)")->required();
  // CLI11 hands lists of one option over together; each --var takes one name.
  command->add_option("--var", request->variables, "Label, or a component of it: vel_CC.x")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--history", request->histories,
                   "A .dat file by its label; levels: the cells of each level over time")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--material", request->material,
                      "Material index (lines: all; else the first stored)");
  command->add_option("--time", request->time, "last, first, #N (N-th output) or a time");
  command->add_option("--slice", request->slice, "Plane of a 3-D run, z=0.5 (the middle)");
  command->add_flag("--radius", request->radius,
                    "Every cell of a 2-D or 3-D run against its distance from the origin");
  command
      ->add_option("--levels", request->levels,
                   "What is drawn of finer levels: boxes (default), the regridder's tiles, only "
                   "outer edges, or none")
      ->check(CLI::IsMember({"boxes", "tiles", "edges", "none"}));
  command->add_option("--exact", request->exact,
                      "auto: the solution that the deck names; none; or a CSV file x,LABEL,...");
  command->add_option("--particles", request->particles,
                      "Particles over a plane, coloured by this label of theirs; p.x: in black");
  command->add_option("--title", request->title, "Heading of the picture");
  command->add_option("-o,--output", request->picture, "Picture: .png, .svg or .pdf");
  command->callback([request, &exit_status] { exit_status = draw_archive(*request); });
}

}  // namespace sluice
