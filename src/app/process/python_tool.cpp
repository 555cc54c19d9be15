// The package lies beside the executable (build tree and installation have the same layout); it is
// run by Debian's own /usr/bin/python3, to which Debian's h5py and matplotlib belong.
#include "app/process/python_tool.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "app/process/data_folder.hpp"
#include "app/process/study_process.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

constexpr const char* python = "/usr/bin/python3";

// The folder that holds the package sluice_tools.
fs::path tools_folder() {
  fs::path tools = data_folder() / "tools";
  if (!fs::exists(tools / "sluice_tools" / "__main__.py"))
    throw SystemError(
        fmt::format("the Python tools are not installed with this executable: searched for {}; "
                    "install with cmake --install, or run the executable in the build tree",
                    (tools / "sluice_tools").string()));
  return tools;
}

}  // namespace

int run_python_tool(const std::vector<std::string>& words, const fs::path& output) {
  if (::access(python, X_OK) != 0)
    throw SystemError(
        fmt::format("pictures need {}; on Debian: apt-get install python3 "
                    "python3-numpy python3-h5py python3-matplotlib",
                    python));
  ProcessRequest request;
  request.words = {python, "-B", "-m", "sluice_tools"};
  request.words.insert(request.words.end(), words.begin(), words.end());
  request.environment = {"PYTHONPATH=" + tools_folder().string()};
  request.output = output;
  return run_process(request);
}

}  // namespace sluice
