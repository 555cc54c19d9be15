// Running the Python package sluice_tools, which draws the pictures.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace sluice {

// `python3 -m sluice_tools` with these words (a tool and its arguments); its exit status. Output:
// of stdout and stderr together; empty: this program's. SystemError with what to install when
// Python or the package is not there.
int run_python_tool(const std::vector<std::string>& words,
                    const std::filesystem::path& output = {});

}  // namespace sluice
