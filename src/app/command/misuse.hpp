// A command line that cannot be understood, told as other faults are.
#pragma once
#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace sluice {

// One line: what was found, what was expected, the nearest option, and which help to read.
std::string text_of_misuse(const CLI::ParseError& problem, const CLI::App& root);

}  // namespace sluice
