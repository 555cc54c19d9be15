#include "app/process/json_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "framework/base/error.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {

JsonFile JsonFile::read(const std::string& file, std::string_view extension) {
  JsonFile read;
  read.file_ = file;
  std::ifstream in(file);
  if (!in) read.refuse(fmt::format("cannot be read; name a {} file", extension));
  try {
    read.root_ = Json::parse({std::istreambuf_iterator<char>(in), {}}, Json::Comments::skipped);
  } catch (const JsonError& problem) {
    read.refuse(fmt::format("this is not JSON: {}", problem.what()));
  }
  if (!read.root_.is_object()) read.refuse("expected an object { ... }");
  return read;
}

void JsonFile::refuse(const std::string& what) const {
  throw InputError(fmt::format("{}: {}", file_, what));
}

void JsonFile::refuse_unknown(const Json& object, const std::vector<std::string>& known) const {
  for (const auto& [key, value] : object.members()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    refuse(fmt::format("unknown entry \"{}\" ({})", key, suggest_name(key, known)));
  }
}

void JsonFile::refuse_unless_known(const std::string& text, const char* what,
                                   const std::vector<std::string>& known) const {
  if (std::find(known.begin(), known.end(), text) != known.end()) return;
  refuse(fmt::format("unknown {} \"{}\" ({})", what, text, suggest_name(text, known)));
}

std::string JsonFile::text(const Json& object, const std::string& key) const {
  if (!object.contains(key)) refuse(fmt::format("entry \"{}\" is missing", key));
  if (!object.at(key).is_text()) refuse(fmt::format("\"{}\" must be a text", key));
  return object.at(key).get<std::string>();
}

std::string JsonFile::text(const Json& object, const std::string& key,
                           const std::string& otherwise) const {
  return object.contains(key) ? text(object, key) : otherwise;
}

double JsonFile::number(const Json& object, const std::string& key) const {
  if (!object.contains(key)) refuse(fmt::format("entry \"{}\" is missing", key));
  const Json& value = object.at(key);
  if (!value.is_number()) refuse(fmt::format("\"{}\" must be a number, not {}", key, value.dump()));
  return value.get<double>();
}

int JsonFile::whole(const Json& object, const std::string& key, int least, int most,
                    int otherwise) const {
  if (!object.contains(key)) return otherwise;
  const Json& value = object.at(key);
  if (!value.is_whole() || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most)
    refuse(fmt::format("\"{}\" must be a whole number from {} to {}, not {}", key, least, most,
                       value.dump()));
  return value.get<int>();
}

const std::vector<Json>& JsonFile::list(const Json& object, const std::string& key) const {
  static const std::vector<Json> none;
  if (!object.contains(key)) return none;
  if (!object.at(key).is_array()) refuse(fmt::format("\"{}\" must be a list", key));
  return object.at(key).entries();
}

std::vector<std::string> JsonFile::overrides(const Json& object, const std::string& key) const {
  return object.contains(key) ? overrides(object.at(key)) : std::vector<std::string>{};
}

std::vector<std::string> JsonFile::overrides(const Json& value) const {
  std::vector<std::string> out;
  const auto add = [&](const Json& one) {
    if (!one.is_text() || one.get<std::string>().find('=') == std::string::npos)
      refuse(
          fmt::format("{} is not an override; expected \"PATH=VALUE\" as for --set", one.dump()));
    out.push_back(one.get<std::string>());
  };
  if (value.is_array()) {
    for (const Json& one : value.entries()) add(one);
  } else {
    add(value);
  }
  return out;
}

std::string JsonFile::deck(const std::string& named) const {
  namespace fs = std::filesystem;
  const fs::path beside = fs::path(file_).parent_path() / named;
  if (fs::exists(beside)) return beside.lexically_normal().string();
  if (fs::exists(named)) return named;
  refuse(fmt::format("the deck {} is neither at {} nor in the working directory", named,
                     beside.lexically_normal().string()));
}

}  // namespace sluice
