// Elements to paste for the laws of the format: of inputs/laws.xml, else of the decks beside it.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "framework/deck/deck.hpp"

namespace sluice {

class LawExamples {
 public:
  // The files that come with the program; without examples where there are none.
  static LawExamples of_program();
  // InputError for a file that is no XML. `decks`: a folder with decks below; empty: none.
  explicit LawExamples(const std::string& file, std::filesystem::path decks = {});

  // <TAG ATTRIBUTE="WORD"> with all that it contains, as XML; empty where no file has it.
  std::string find(const std::string& tag, const std::string& attribute,
                   const std::string& word) const;
  const DeckNode* root() const { return root_.get(); }  // nullptr: no examples

 private:
  LawExamples() = default;
  std::string find_in_decks(const std::string& tag, const std::string& attribute,
                            const std::string& word) const;

  std::unique_ptr<DeckNode> root_;
  std::filesystem::path decks_;
};

}  // namespace sluice
