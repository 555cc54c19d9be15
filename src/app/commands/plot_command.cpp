// sluice plot UDA...: pictures of archives. sluice movie UDA...: the same over time.
#include <fmt/format.h>

#include <memory>

#include "app/command/archive_picture.hpp"
#include "app/command/command_line.hpp"
#include "app/loading/last_output.hpp"

namespace sluice {
namespace {

// A picture of the last output must not pass for one of the end of the run.
void tell_last_output(const PictureRequest& request) {
  for (const char* other : {"--time", "--checkpoint", "--history", "--to"})
    if (request.options.has(other)) return;
  for (const std::string& archive : request.archives)
    if (const std::string note = last_output_note(archive); !note.empty())
      fmt::print(stderr, "sluice: note: {}\n", note);
}

void declare_pictures(Command& command, PictureCommand which) {
  auto request = std::make_shared<PictureRequest>();
  command.option("UDA", request->archives, "Archives (folders or links), one or several")
      .required();
  request->options.declare(command, which);
  command.action([request, which] {
    tell_last_output(*request);
    return draw_archives(*request, which);
  });
}

}  // namespace

void declare_plot_command(Command& command) {
  declare_pictures(command, PictureCommand::plot);
}

void declare_movie_command(Command& command) {
  declare_pictures(command, PictureCommand::movie);
}

}  // namespace sluice
