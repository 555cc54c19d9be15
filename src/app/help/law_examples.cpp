// Looking examples up.
#include "app/help/law_examples.hpp"

#include <algorithm>
#include <vector>

#include "app/process/data_folder.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/xml_reader.hpp"

namespace sluice {
namespace {

const DeckNode* find_below(const DeckNode& parent, const std::string& tag,
                           const std::string& attribute, const std::string& word) {
  for (const auto& child : parent.children)
    if (child->name == tag && child->attribute(attribute) == word) return child.get();
  for (const auto& child : parent.children) {
    if (const DeckNode* found = find_below(*child, tag, attribute, word)) return found;
  }
  return nullptr;
}

}  // namespace

LawExamples LawExamples::of_program() {
  const std::filesystem::path folder = data_folder() / "inputs", file = folder / "laws.xml";
  std::error_code ignored;
  return std::filesystem::exists(file, ignored) ? LawExamples(file.string(), folder)
                                                : LawExamples();
}

LawExamples::LawExamples(const std::string& file, std::filesystem::path decks)
    : decks_(std::move(decks)) {
  ReadBudget budget;
  XmlTree tree = read_xml_file(file, file, budget);
  for (const Fault& fault : tree.faults) throw InputError(to_string(fault));
  root_ = std::move(tree.root);
}

std::string LawExamples::find(const std::string& tag, const std::string& attribute,
                              const std::string& word) const {
  const DeckNode* found = root_ == nullptr ? nullptr : find_below(*root_, tag, attribute, word);
  return found != nullptr ? element_xml(*found) : find_in_decks(tag, attribute, word);
}

std::string LawExamples::find_in_decks(const std::string& tag, const std::string& attribute,
                                       const std::string& word) const {
  if (decks_.empty()) return "";
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(decks_))
    if (entry.path().extension() == ".ups") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string& file : files) {
    ReadBudget budget;
    const XmlTree tree = read_xml_file(file, file, budget);
    const DeckNode* found =
        tree.root == nullptr ? nullptr : find_below(*tree.root, tag, attribute, word);
    if (found != nullptr) return element_xml(*found);
  }
  return "";
}

}  // namespace sluice
