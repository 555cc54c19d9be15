// The package lies beside the executable (build tree and installation have the same layout). It is
// run by the interpreter that SLUICE_PYTHON names, else by python3 on the PATH; where that has no
// h5py or matplotlib, the package hands itself on to /usr/bin/python3, to which Debian's belong.
#include "app/process/python_tool.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include "app/process/data_folder.hpp"
#include "app/process/study_process.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

std::string on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / program;
    if (!folder.empty() && ::access(file.c_str(), X_OK) == 0) return file.string();
  }
  throw SystemError(
      fmt::format("pictures need {}, which is not on the PATH; on Debian: apt-get install python3 "
                  "python3-numpy python3-h5py python3-matplotlib; SLUICE_PYTHON may name another "
                  "interpreter",
                  program));
}

std::string interpreter() {
  const char* named = std::getenv("SLUICE_PYTHON");
  if (named == nullptr || *named == '\0') return on_path("python3");
  if (std::string(named).find('/') == std::string::npos) return on_path(named);
  if (::access(named, X_OK) != 0)
    throw SystemError(fmt::format(
        "SLUICE_PYTHON={}: there is no such program; expected a Python interpreter with "
        "numpy, h5py and matplotlib",
        named));
  return named;
}

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
  ProcessRequest request;
  request.words = {interpreter(), "-B", "-m", "sluice_tools"};
  request.words.insert(request.words.end(), words.begin(), words.end());
  request.environment = {"PYTHONPATH=" + tools_folder().string()};
  request.output = output;
  return run_process(request);
}

}  // namespace sluice
