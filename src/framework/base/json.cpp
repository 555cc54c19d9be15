#include "framework/base/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace sluice {
namespace {

using Library = nlohmann::ordered_json;

Json from_library(const Library& from) {
  switch (from.type()) {
    case Library::value_t::boolean:
      return from.get<bool>();
    case Library::value_t::number_unsigned: {
      const auto n = from.get<std::uint64_t>();
      if (n > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
        return static_cast<double>(n);
      return n;
    }
    case Library::value_t::number_integer:
      return from.get<std::int64_t>();
    case Library::value_t::number_float:
      return from.get<double>();
    case Library::value_t::string:
      return from.get<std::string>();
    case Library::value_t::array: {
      Json to = Json::array();
      for (const Library& entry : from) to.push_back(from_library(entry));
      return to;
    }
    case Library::value_t::object: {
      Json to = Json::object();
      for (const auto& [name, value] : from.items()) to[name] = from_library(value);
      return to;
    }
    default:
      return nullptr;
  }
}

Library to_library(const Json& from) {
  switch (from.kind()) {
    case Json::Kind::boolean:
      return from.get<bool>();
    case Json::Kind::whole:
      return from.get<std::int64_t>();
    case Json::Kind::real:
      return from.get<double>();
    case Json::Kind::text:
      return from.get<std::string>();
    case Json::Kind::array: {
      Library to = Library::array();
      for (const Json& entry : from.entries()) to.push_back(to_library(entry));
      return to;
    }
    case Json::Kind::object: {
      Library to = Library::object();
      for (const auto& [name, value] : from.members()) to[name] = to_library(value);
      return to;
    }
    default:
      return nullptr;
  }
}

const char* name_of(Json::Kind kind) {
  static const char* const names[] = {"null",   "true or false", "a whole number", "a number",
                                      "a text", "a list",        "an object"};
  return names[static_cast<int>(kind)];
}

}  // namespace

Json::Json() = default;
Json::Json(std::nullptr_t) {}
Json::Json(double x) : kind_(Kind::real), real_(x) {}
Json::Json(std::string text) : kind_(Kind::text), text_(std::move(text)) {}
Json::Json(std::string_view text) : Json(std::string(text)) {}
Json::Json(const char* text) : Json(std::string(text)) {}
Json::Json(Scalar s) : kind_(s.boolean ? Kind::boolean : Kind::whole), whole_(s.value) {}
Json::Json(const Json&) = default;
Json::Json(Json&&) noexcept = default;
Json& Json::operator=(const Json&) = default;
Json& Json::operator=(Json&&) noexcept = default;
Json::~Json() = default;

Json::Json(std::initializer_list<Json> list) {
  const bool pairs = std::all_of(list.begin(), list.end(), [](const Json& one) {
    return one.is_array() && one.size() == 2 && one.entries_[0].is_text();
  });
  kind_ = pairs ? Kind::object : Kind::array;
  if (!pairs) {
    entries_ = list;
    return;
  }
  for (const Json& one : list) (*this)[one.entries_[0].text_] = one.entries_[1];
}

Json Json::array() {
  Json list;
  list.kind_ = Kind::array;
  return list;
}

Json Json::object() {
  Json object;
  object.kind_ = Kind::object;
  return object;
}

Json Json::parse(const std::string& text, Comments comments) {
  try {
    return from_library(Library::parse(text, nullptr, true, comments == Comments::skipped));
  } catch (const Library::exception& problem) {
    throw JsonError(problem.what());
  }
}

Json Json::parse_or_null(const std::string& text) {
  const Library read = Library::parse(text, nullptr, false);
  return read.is_discarded() ? Json() : from_library(read);
}

std::string Json::dump(int indent) const {
  return to_library(*this).dump(indent, ' ', false, Library::error_handler_t::replace);
}

void Json::refuse(const char* wanted) const {
  throw JsonError(fmt::format("found {} where {} is expected", name_of(kind_), wanted));
}

std::size_t Json::size() const {
  return is_object() ? members_.size() : entries_.size();
}

const std::vector<Json>& Json::entries() const {
  if (!is_array()) refuse("a list");
  return entries_;
}

const std::vector<Json::Member>& Json::members() const {
  if (!is_object()) refuse("an object");
  return members_;
}

const Json& Json::at(std::size_t n) const {
  if (n >= entries().size())
    throw JsonError(fmt::format("a list of {} has no entry {}", entries_.size(), n + 1));
  return entries_[n];
}

const Json* Json::find(const std::string& name) const {
  for (const Member& m : members_)
    if (m.first == name) return &m.second;
  return nullptr;
}

const Json& Json::at(const std::string& name) const {
  if (!is_object()) refuse("an object");
  if (const Json* found = find(name)) return *found;
  throw JsonError(fmt::format("the entry \"{}\" is missing", name));
}

void Json::push_back(Json entry) {
  if (is_null()) kind_ = Kind::array;
  if (!is_array()) refuse("a list");
  entries_.push_back(std::move(entry));
}

Json& Json::operator[](const std::string& name) {
  if (is_null()) kind_ = Kind::object;
  if (!is_object()) refuse("an object");
  for (Member& m : members_)
    if (m.first == name) return m.second;
  return members_.emplace_back(name, Json()).second;
}

bool Json::boolean() const {
  if (kind_ != Kind::boolean) refuse("true or false");
  return whole_ != 0;
}

double Json::real() const {
  if (is_whole()) return static_cast<double>(whole_);
  if (kind_ != Kind::real) refuse("a number");
  return real_;
}

std::int64_t Json::whole() const {
  if (is_whole()) return whole_;
  if (kind_ != Kind::real) refuse("a number");
  return static_cast<std::int64_t>(real_);
}

const std::string& Json::text() const {
  if (!is_text()) refuse("a text");
  return text_;
}

bool Json::operator==(const Json& other) const {
  if (is_number() && other.is_number() && kind_ != other.kind_) return real() == other.real();
  if (kind_ != other.kind_ || size() != other.size()) return false;
  for (const Member& m : members_) {
    const Json* same = other.find(m.first);
    if (same == nullptr || !(*same == m.second)) return false;
  }
  return whole_ == other.whole_ && real_ == other.real_ && text_ == other.text_ &&
         entries_ == other.entries_;
}

}  // namespace sluice
