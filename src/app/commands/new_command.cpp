// sluice new NAME: a commented deck of one's own, made from a template that runs.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/process/data_folder.hpp"
#include "app/process/text_sink.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

struct NewRequest {
  std::string name, like = "shock_tube";
  bool list = false;
};

fs::path template_folder() {
  return data_folder() / "inputs" / "templates";
}

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(template_folder(), ignored))
    if (entry.path().extension() == ".ups") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  if (names.empty())
    throw SystemError(fmt::format("{} has no templates; is Sluice installed as a whole?",
                                  template_folder().string()));
  return names;
}

std::string text_of_template(const std::string& name) {
  std::ifstream in(template_folder() / (name + ".ups"));
  return {std::istreambuf_iterator<char>(in), {}};
}

// What stands between two marks; the template has both.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const auto begin = text.find(from) + from.size();
  return text.substr(begin, text.find(to, begin) - begin);
}

void replace_between(std::string& text, const std::string& from, const std::string& to,
                     const std::string& by) {
  const auto begin = text.find(from) + from.size();
  text.replace(begin, text.find(to, begin) - begin, by);
}

// "a shock tube of air: 10 bar against 1 bar", without line breaks.
std::string problem_of(const std::string& text) {
  std::string words;
  for (const char c : between(text, "Problem:", "\n  Reference:")) {
    const bool blank = c == ' ' || c == '\n';
    if (blank && (words.empty() || words.back() == ' ')) continue;
    words += blank ? ' ' : c;
  }
  return words;
}

int list_templates() {
  for (const std::string& name : template_names())
    fmt::print("{:<16} {}\n", name, problem_of(text_of_template(name)));
  return 0;
}

int make_deck(const NewRequest& r) {
  if (r.list) return list_templates();
  const std::vector<std::string> known = template_names();
  if (std::find(known.begin(), known.end(), r.like) == known.end())
    throw InputError(
        fmt::format("there is no template '{}' ({})", r.like, suggest_name(r.like, known)));
  if (r.name.empty()) throw InputError("give the new deck a name: sluice new NAME");
  fs::path file = r.name;
  if (file.extension() != ".ups") file += ".ups";
  if (fs::exists(file))
    throw InputError(fmt::format("{} is there already; choose another name", file.string()));
  const std::string name = file.stem().string();
  std::string text = text_of_template(r.like);
  const std::string head = fmt::format(
      "\n  {0}: {1}\n\n    sluice check {2}        all faults, with line and column\n    sluice "
      "plan {2}         what will be computed, and what not\n    sluice run {2}          writes "
      "{0}.uda; then sluice plot {0}.uda\n    sluice help NAME           each tag, law and label\n",
      name, problem_of(text), file.filename().string());
  replace_between(text, "<!--", "-->", head);
  replace_between(text, "<title>", "</title>", name);
  replace_between(text, "<filebase>", "</filebase>", name + ".uda");
  write_text(file.string(), text);
  fmt::print("{} is written; run it with\nsluice run {} --plot\n", file.string(), file.string());
  return 0;
}

}  // namespace

void declare_new_command(Command& command) {
  auto r = std::make_shared<NewRequest>();
  command.option("NAME", r->name, "The deck to write: NAME.ups");
  command.option("--like", r->like, "The template (default shock_tube)");
  command.flag("--list", r->list, "List the templates");
  command.action([r] { return make_deck(*r); });
}

}  // namespace sluice
