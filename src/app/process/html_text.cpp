#include "app/process/html_text.hpp"

#include <array>
#include <cstdint>
#include <stdexcept>

namespace sluice {
namespace {

bool is_number(const std::string& cell) {
  return !cell.empty() && (cell[0] == '-' || cell[0] == '+' || (cell[0] >= '0' && cell[0] <= '9'));
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - n);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[n + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= count ? letters[group >> (18 - 6 * k) & 63U] : '=';
  }
  return out;
}

void HtmlTable::row(std::vector<std::string> cells) {
  if (cells.size() != titles_.size()) throw std::logic_error("a row of another number of cells");
  rows_.push_back(std::move(cells));
}

std::string HtmlTable::text() const {
  std::string out = "<table><tr>";
  for (const std::string& title : titles_) out += "<th>" + html_text(title) + "</th>";
  out += "</tr>\n";
  for (const std::vector<std::string>& cells : rows_) {
    out += "<tr>";
    for (const std::string& cell : cells)
      out += (is_number(cell) ? "<td class=n>" : "<td>") + html_text(cell) + "</td>";
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

}  // namespace sluice
