// Finding the files that come with the command.
#include "app/process/data_folder.hpp"

#include "app/process/study_process.hpp"
#include "sluice_version.hpp"

namespace sluice {

namespace fs = std::filesystem;

fs::path data_folder() {
  return (own_executable().parent_path() / version::kDataFromBin).lexically_normal();
}

std::string find_data(const std::string& name, const std::string& folder,
                      const std::string& extension) {
  std::error_code ignored;
  if (fs::exists(name, ignored) || fs::path(name).has_parent_path()) return name;
  for (const std::string& file : {name, name + extension}) {
    const fs::path ours = data_folder() / folder / file;
    if (fs::is_regular_file(ours, ignored)) return ours.string();
  }
  return name;
}

}  // namespace sluice
