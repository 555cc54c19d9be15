#include "models/located_file.hpp"

#include <filesystem>

namespace sluice::models {

void locate_file(DeckNode* node) {
  namespace fs = std::filesystem;
  if (node == nullptr || node->text.empty()) return;
  const fs::path beside = fs::path(node->where.file).parent_path() / node->text;
  std::error_code ignored;
  if (fs::exists(node->text, ignored))
    node->text = fs::absolute(node->text).string();
  else if (fs::exists(beside, ignored))
    node->text = fs::absolute(beside).string();
}

}  // namespace sluice::models
