// Elements to paste for the laws of the format: inputs/laws.xml, read by whoever asks for help.
#pragma once
#include <memory>
#include <string>

#include "framework/deck/deck.hpp"

namespace sluice {

class LawExamples {
 public:
  // The file that comes with the program; without examples where there is none.
  static LawExamples of_program();
  // InputError for a file that is no XML.
  explicit LawExamples(const std::string& file);

  // <TAG ATTRIBUTE="WORD"> with all that it contains, as XML; empty where the file has none.
  std::string find(const std::string& tag, const std::string& attribute,
                   const std::string& word) const;
  const DeckNode* root() const { return root_.get(); }  // nullptr: no examples

 private:
  LawExamples() = default;
  std::unique_ptr<DeckNode> root_;
};

}  // namespace sluice
