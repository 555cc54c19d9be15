// sluice plot UDA: pictures of an archive.
#include <fmt/format.h>

#include <memory>

#include "app/command/archive_picture.hpp"
#include "app/command/command_line.hpp"
#include "app/loading/last_output.hpp"

namespace sluice {

void declare_plot_command(Command& command) {
  auto request = std::make_shared<PictureRequest>();
  command.option("UDA", request->archive, "Archive (folder or link)").required();
  command
      .option("--var", request->variables,
              "Label, or a component of it: vel_CC.x, p.stress.xy (a stress without a component: "
              "von Mises)")
      .quietly_repeatable();
  command
      .option("--history", request->histories,
              "A .dat file by its label; levels: the cells of each level over time")
      .quietly_repeatable();
  command.option("--material", request->material,
                 "Material index; absent: all in line plots, otherwise the first stored");
  command.option("--time", request->time, "last, first, #N (N-th output) or a time");
  command.flag("--checkpoint", request->checkpoint,
               "Draw a checkpoint (the state of the run), not an output; --time selects it");
  command.option("--slice", request->slice, "Plane of a 3-D run, z=0.5 (the middle)");
  command.flag("--radius", request->radius,
               "Every cell of a 2-D or 3-D run against its distance from the origin");
  command
      .option("--levels", request->levels,
              "What to draw of finer levels: their outer edges (default), boxes, the regridder's "
              "tiles, or none")
      .one_of({"edges", "boxes", "tiles", "none"});
  command.option("--exact", request->exact,
                 "auto: the solution that the deck names; none; or a CSV file x,LABEL,...");
  command.option("--particles", request->particles,
                 "Particles over a plane, coloured by this particle label; p.x: in black");
  command.flag("--outline", request->outline, "Outlines of the bodies of each material");
  command.option("--paths", request->paths,
                 "Paths of this number of particles of each material, from the first output on");
  command.option("--title", request->title, "Title of the picture");
  command.option("-o,--output", request->picture, "Picture: .png, .svg or .pdf");
  command.action([request] {
    if (request->time == "last" && !request->checkpoint && request->histories.empty())
      if (const std::string note = last_output_note(request->archive); !note.empty())
        fmt::print(stderr, "sluice plot: note: {}\n", note);
    return draw_archive(*request);
  });
}

}  // namespace sluice
