// Tools of the public suite under their own names: links to this executable, which looks at the
// name that it is called by. Options, formats of output and exit statuses are theirs, so that
// scripts run on; both formats of archives are read.
//
// A tool is one file and one row of the table.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace sluice {

struct ClassicCall {
  std::string name;                // lineextract
  std::vector<std::string> words;  // behind it
  // Runs a command of sluice with these words; its exit status.
  std::function<int(const std::vector<std::string>&)> sluice;
};

struct ClassicTool {
  const char* name;
  const char* summary;             // one line
  int (*run)(const ClassicCall&);  // the exit status; Error for what is wrong
  int bad_input = 1;               // status of a faulty command line or archive
};

std::span<const ClassicTool> classic_tools();
// By the file name of a path; nullptr: none of them.
const ClassicTool* find_classic_tool(const std::string& program);
// The exit status; messages of errors are printed here.
int run_classic_tool(const ClassicTool& tool, const ClassicCall& call);

}  // namespace sluice
