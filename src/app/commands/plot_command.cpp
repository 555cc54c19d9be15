// sluice plot UDA...: pictures of archives. sluice movie UDA...: the same over time.
#include <memory>

#include "app/command/archive_picture.hpp"
#include "app/command/command_line.hpp"

namespace sluice {
namespace {

void declare_pictures(Command& command, PictureCommand which) {
  auto request = std::make_shared<PictureRequest>();
  command.option("UDA", request->archives, "Archives (folders or links), one or several")
      .required();
  request->options.declare(command, which);
  command.action([request, which] { return draw_archives(*request, which); });
}

}  // namespace

void declare_plot_command(Command& command) {
  declare_pictures(command, PictureCommand::plot);
}

void declare_movie_command(Command& command) {
  declare_pictures(command, PictureCommand::movie);
}

}  // namespace sluice
