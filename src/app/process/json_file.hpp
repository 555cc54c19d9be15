// JSON files that users write: parts of them, each fault an InputError with the file, what was
// found and what was expected.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/json.hpp"

namespace sluice {

class JsonFile {
 public:
  // Reads a file, in which // comments are skipped. `extension` (".study") is for the message of a
  // file that cannot be read.
  static JsonFile read(const std::string& file, std::string_view extension);

  const std::string& file() const { return file_; }
  const Json& root() const { return root_; }  // an object

  // InputError with the name of the file.
  [[noreturn]] void refuse(const std::string& what) const;
  // Every member of `object` must be one of `known`.
  void refuse_unknown(const Json& object, const std::vector<std::string>& known) const;
  // `text` must be one of `known`; `what` says what it is.
  void refuse_unless_known(const std::string& text, const char* what,
                           const std::vector<std::string>& known) const;

  std::string text(const Json& object, const std::string& key) const;  // must be there
  std::string text(const Json& object, const std::string& key, const std::string& otherwise) const;
  double number(const Json& object, const std::string& key) const;  // must be there
  int whole(const Json& object, const std::string& key, int least, int most, int otherwise) const;
  const std::vector<Json>& list(const Json& object, const std::string& key) const;  // may be empty
  // A text or a list of texts, each PATH=VALUE; none where the key is missing.
  std::vector<std::string> overrides(const Json& object, const std::string& key) const;
  std::vector<std::string> overrides(const Json& value) const;
  // Of a deck, found from the folder of the file, else from the working directory, as includes in
  // decks are.
  std::string deck(const std::string& named) const;

 private:
  std::string file_;
  Json root_;
};

}  // namespace sluice
