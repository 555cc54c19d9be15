// Pictures and movies of archives: drawn by Python, over the exact solution if the deck names one.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/command/picture_options.hpp"

namespace sluice {

struct PictureRequest {
  std::vector<std::string> archives;
  PictureOptions options;
};

// The exit status of the drawing program. Output: where it tells what it did and what is wrong;
// empty: where this program does.
int draw_archives(const PictureRequest& request, PictureCommand which = PictureCommand::plot,
                  const std::filesystem::path& output = {});

}  // namespace sluice
