// Looking examples up.
#include "app/help/law_examples.hpp"

#include <filesystem>

#include "app/process/data_folder.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/xml_reader.hpp"

namespace sluice {
namespace {

const DeckNode* find_below(const DeckNode& parent, const std::string& tag,
                           const std::string& attribute, const std::string& word) {
  for (const auto& child : parent.children) {
    if (child->name == tag && child->attribute(attribute) == word) return child.get();
    if (const DeckNode* found = find_below(*child, tag, attribute, word)) return found;
  }
  return nullptr;
}

}  // namespace

LawExamples LawExamples::of_program() {
  const std::filesystem::path file = data_folder() / "inputs" / "laws.xml";
  std::error_code ignored;
  return std::filesystem::exists(file, ignored) ? LawExamples(file.string()) : LawExamples();
}

LawExamples::LawExamples(const std::string& file) {
  ReadBudget budget;
  XmlTree tree = read_xml_file(file, file, budget);
  for (const Fault& fault : tree.faults) throw InputError(to_string(fault));
  root_ = std::move(tree.root);
}

std::string LawExamples::find(const std::string& tag, const std::string& attribute,
                              const std::string& word) const {
  const DeckNode* found = root_ == nullptr ? nullptr : find_below(*root_, tag, attribute, word);
  return found == nullptr ? "" : element_xml(*found);
}

}  // namespace sluice
