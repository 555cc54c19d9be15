#include "app/regress/suite_list.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>

#include "framework/base/error.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> quoted_words(const std::string& text) {
  static const std::regex word("[\"']([^\"']*)[\"']");
  std::vector<std::string> words;
  for (std::sregex_iterator at(text.begin(), text.end(), word), end; at != end; ++at)
    words.push_back((*at)[1]);
  return words;
}

// "abs_tolerance=1e-5" with this name: its number.
bool read_number(const std::string& flag, const std::string& name, double& value) {
  if (!flag.starts_with(name + "=")) return false;
  const std::string text = flag.substr(name.size() + 1);
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0 || !(value >= 0))
    throw InputError(fmt::format("'{}': '{}' is no tolerance", flag, text));
  return true;
}

}  // namespace

void SuiteTest::apply(RegressCase& c) const {
  if (c.deck.filename().string() != deck) return;
  c.ranks = ranks;
  // What the tester takes where nothing is said.
  c.absolute = 1e-9;
  c.tolerance = 1e-6;
  for (const std::string& flag : flags) {
    if (flag == "no_restart") c.restart_in_the_middle = false;
    if (flag == "exactComparison") c.absolute = c.tolerance = 0;
    read_number(flag, "abs_tolerance", c.absolute);
    read_number(flag, "rel_tolerance", c.tolerance);
  }
}

std::vector<SuiteTest> read_suite_list(const fs::path& file) {
  std::ifstream in(file);
  std::string text, line;
  while (std::getline(in, line)) text += line.substr(0, line.find('#')) + "\n";
  static const std::regex entry(
      "\\(\\s*[\"']([^\"']+)[\"']\\s*,\\s*[\"']([^\"']+)[\"']\\s*,\\s*([0-9]+)[0-9.]*\\s*,"
      "\\s*[\"'][^\"']*[\"']\\s*(,\\s*\\[([^\\]]*)\\]\\s*)?,?\\s*\\)");
  std::vector<SuiteTest> tests;
  for (std::sregex_iterator at(text.begin(), text.end(), entry), end; at != end; ++at) {
    SuiteTest test;
    test.name = (*at)[1];
    test.deck = fs::path((*at)[2].str()).filename().string();
    test.ranks = std::max(1, std::stoi((*at)[3]));
    test.flags = quoted_words((*at)[5]);
    try {
      RegressCase probe;
      probe.deck = test.deck;
      test.apply(probe);
    } catch (const InputError& fault) {
      throw InputError(fmt::format("{}: test '{}': {}", file.string(), test.name, fault.what()));
    }
    tests.push_back(std::move(test));
  }
  return tests;
}

}  // namespace sluice
