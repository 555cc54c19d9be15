// Runs of the command by a shell script, and what they report.
#pragma once
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "app/process/study_process.hpp"

namespace sluice::properties {

// The report of a run (--json FILE).
inline nlohmann::json record(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in);
}

// A script carried out in a folder, where its output goes into the file log.
inline ProcessRequest shell(const std::filesystem::path& folder, const std::string& script) {
  ProcessRequest request;
  request.words = {"/bin/sh", "-c", "cd '" + folder.string() + "'\n" + script};
  request.environment = {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"};
  request.output = folder / "log";
  return request;
}

}  // namespace sluice::properties
