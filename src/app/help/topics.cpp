#include "app/help/topics.hpp"

#include <fmt/format.h>

#include "app/help/ending_messages.hpp"
#include "app/help/law_examples.hpp"
#include "app/loading/sluice_schema.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/format_tags.hpp"
#include "framework/deck/help/deck_help.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/field/label.hpp"

namespace sluice {
namespace {

std::string help_on_label(const std::string& name) {
  const std::optional<Label> label = find_label(name);
  if (!label) return "";
  const LabelInfo& l = label->info();
  return fmt::format(
      "{}, a label: {}\n  {}{}, {}\n  save it with <save label=\"{}\"/> in "
      "<DataArchiver>, or with --save {}\n",
      l.name, l.definition, name_of(l.type), l.unit.empty() ? "" : " in " + l.unit,
      name_of(l.centring), l.name, l.name);
}

void append(std::string& text, const std::string& more) {
  if (!text.empty() && !more.empty()) text += '\n';
  text += more;
}

[[noreturn]] void refuse(const std::string& name, const Schema& schema,
                         const std::vector<std::string>& commands) {
  const std::string last = name.substr(name.rfind('/') + 1);
  if (const auto parents = parents_in_format(last); !parents.empty())
    throw InputError(fmt::format("<{}> (in {}) is known to the format, but not supported yet", last,
                                 parents.front().empty() ? "the root" : parents.front()));
  std::vector<std::string> names = commands;  // first: they win where two are as near
  for (std::string& tag : tag_names(schema)) names.push_back(std::move(tag));
  for (std::string& word : law_words(schema)) names.push_back(std::move(word));
  for (const Label label : all_labels()) names.push_back(label.name());
  const auto nearest = nearest_name(last, names);
  throw InputError(
      fmt::format("there is no command, tag, law, label or message '{}'{}", name,
                  nearest ? fmt::format(" (did you mean '{}'?)", *nearest) : "; see sluice help"));
}

}  // namespace

std::string help_on(const std::string& name, const std::vector<std::string>& commands) {
  const Schema schema = sluice_schema();
  const LawExamples examples = LawExamples::of_program();
  std::string text = help_on_tag(schema, name);
  append(text,
         help_on_law(schema, name, [&](const auto& tag, const auto& attribute, const auto& word) {
           return examples.find(tag, attribute, word);
         }));
  append(text, help_on_label(name));
  append(text, help_on_message(name));
  if (text.empty()) refuse(name, schema, commands);
  return text;
}

}  // namespace sluice
