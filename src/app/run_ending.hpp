// What `sluice run` adds at its end: the error against the deck's exact solution, and a picture.
#pragma once
#include <filesystem>
#include <string>

namespace sluice {

// A line for each saved variable that the exact solution has; empty when the deck names none.
std::string error_lines(const std::filesystem::path& archive);

// Draws the last output into the archive's folder; the picture's path.
// SystemError when it cannot be drawn.
std::filesystem::path draw_picture(const std::filesystem::path& archive);

}  // namespace sluice
