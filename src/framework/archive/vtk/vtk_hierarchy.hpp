// Several levels of one output: an image a box, and the file that puts them together.
#pragma once
#include <filesystem>
#include <string>

#include "framework/archive/vtk/vtk_step.hpp"

namespace sluice {

// Both write their images into folder/name/ and return the name of the file over them.
std::string write_vtk_blocks(const VtkStep& step, const Grid& grid,
                             const std::filesystem::path& folder, const std::string& name);
std::string write_vtk_amr(const VtkStep& step, const Grid& grid,
                          const std::filesystem::path& folder, const std::string& name);

}  // namespace sluice
