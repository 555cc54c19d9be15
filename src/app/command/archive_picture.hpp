// The picture of an archive: drawn by Python, over the exact solution if the deck names one.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace sluice {

struct PictureRequest {
  std::string archive;
  std::vector<std::string> variables, histories;
  std::string material, slice, title, levels, particles;
  std::string time = "last";
  std::string paths;           // of so many particles of each material
  bool outline = false;        // of bodies
  bool checkpoint = false;     // in place of an output
  bool radius = false;         // every cell by its distance from the origin
  std::string exact = "auto";  // auto: what the deck names; none; or a CSV file
  std::string picture = "picture.png";
};

// The exit status of the drawing program. Output: where it tells what it did and what is wrong;
// empty: where this program does.
int draw_archive(const PictureRequest& request, const std::filesystem::path& output = {});

}  // namespace sluice
