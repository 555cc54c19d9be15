// Pieces of HTML pages that stand by themselves: no file, font or script from elsewhere.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

// With < > & and quotes as entities.
std::string html_text(std::string_view text);
std::string base64(std::string_view bytes);

// Rows of cells; numbers stand to the right.
class HtmlTable {
 public:
  explicit HtmlTable(std::vector<std::string> titles) : titles_(std::move(titles)) {}
  // Plain text. std::logic_error for another number of cells than titles.
  void row(std::vector<std::string> cells);
  bool empty() const { return rows_.empty(); }
  std::string text() const;

 private:
  std::vector<std::string> titles_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace sluice
