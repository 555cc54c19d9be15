// Where the files lie that come with the command: tools, inputs, regression.
#pragma once
#include <filesystem>
#include <string>

namespace sluice {

// The folder share/sluice of this executable; build tree and installation have the same layout.
std::filesystem::path data_folder();

// A file as the user named it; one that is not there, and whose name has no folder, is sought in
// `folder` of the data folder, also without its `extension`.
std::string find_data(const std::string& name, const std::string& folder,
                      const std::string& extension);

}  // namespace sluice
