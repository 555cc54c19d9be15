// The small XML files of an archive: a plain tree, and a checksum in the last line.
//
// A sealed text ends with the line `<!-- crc32c 89abcdef -->`, the CRC-32C of all bytes before that
// line: one flipped bit in a time or an index is then an error and not another number.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/base/vec3.hpp"

namespace sluice {

// Something on disk is not what was written; the message names the file.
class DamageError : public InputError {
 public:
  using InputError::InputError;
};

struct XmlElement {
  std::string name;
  std::string text;  // ends trimmed
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;

  XmlElement() = default;
  explicit XmlElement(std::string element_name, std::string element_text = {})
      : name(std::move(element_name)), text(std::move(element_text)) {}

  XmlElement& add(std::string child_name, std::string child_text = {});
  XmlElement& set(std::string attribute_name, std::string value);

  const XmlElement* child(std::string_view child_name) const;  // nullptr when absent
  std::optional<std::string> attribute(std::string_view attribute_name) const;
  // These throw DamageError when it is absent; `context` names the file.
  const XmlElement& need(std::string_view child_name, const std::string& context) const;
  std::string need_attribute(std::string_view attribute_name, const std::string& context) const;
};

// DamageError for what is not XML.
XmlElement parse_xml(std::string_view text, const std::string& context);
std::string to_text(const XmlElement& root);

std::string seal(std::string xml);
// In a folder that nothing names yet, not flushed; publish_sealed flushes it, with all else that
// has been written, and replaces a file that is read.
void write_sealed(const std::filesystem::path& path, const XmlElement& root);
void publish_sealed(const std::filesystem::path& path, const XmlElement& root);
// DamageError where the last line does not fit the rest.
XmlElement read_sealed(const std::filesystem::path& path);

// Numbers as the archive writes them: 17 digits, "[1, 2, 3]". DamageError for other text.
std::string real_text(double value);
std::string triple_text(IntVec3 v);
std::string triple_text(Vec3 v);
double parse_real(std::string_view text, const std::string& context);
std::int64_t parse_integer(std::string_view text, const std::string& context);
int parse_int(std::string_view text, const std::string& context);
IntVec3 parse_int_triple(std::string_view text, const std::string& context);
Vec3 parse_real_triple(std::string_view text, const std::string& context);

}  // namespace sluice
