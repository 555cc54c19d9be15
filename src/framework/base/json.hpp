// JSON as a plain value, to write reports and to read what they or users say. The library that
// reads and prints it is compiled in json.cpp alone: its templates would cost each file that
// includes it several seconds.
#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sluice {

// A text that is no JSON, or a value of another kind or name than asked for.
class JsonError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Json {
 public:
  enum class Kind { null, boolean, whole, real, text, array, object };
  using Member = std::pair<std::string, Json>;

  Json();
  Json(std::nullptr_t);
  Json(double x);
  Json(std::string text);
  Json(std::string_view text);
  Json(const char* text);
  template <std::integral T>
  Json(T n) : Json(Scalar{std::is_same_v<T, bool>, static_cast<std::int64_t>(n)}) {}
  template <class T>
  Json(const std::vector<T>& list) : Json(array()) {
    for (const T& one : list) push_back(one);
  }
  template <class T, std::size_t N>
  Json(const std::array<T, N>& list) : Json(array()) {
    for (const T& one : list) push_back(one);
  }
  // {{"name", value}, ...}, pairs of a text and a value, is an object; any other list is an array.
  Json(std::initializer_list<Json> list);
  Json(const Json&);
  Json(Json&&) noexcept;
  Json& operator=(const Json&);
  Json& operator=(Json&&) noexcept;
  ~Json();

  static Json array();
  static Json object();
  enum class Comments { refused, skipped };
  // JsonError for a text that is no JSON.
  static Json parse(const std::string& text, Comments comments = Comments::refused);
  // null instead of an error.
  static Json parse_or_null(const std::string& text);
  // In one line, or indented by so many spaces. Numbers read back with the same bits; NaN and
  // infinities become null, bytes that are no UTF-8 the sign that stands for such.
  std::string dump(int indent = -1) const;

  Kind kind() const { return kind_; }
  bool is_null() const { return kind_ == Kind::null; }
  bool is_whole() const { return kind_ == Kind::whole; }
  bool is_number() const { return kind_ == Kind::whole || kind_ == Kind::real; }
  bool is_text() const { return kind_ == Kind::text; }
  bool is_array() const { return kind_ == Kind::array; }
  bool is_object() const { return kind_ == Kind::object; }

  // bool, a number, std::string, or std::vector or std::array of such. JsonError for another kind.
  template <class T>
  T get() const {
    return read(static_cast<T*>(nullptr));
  }

  // Entries of an array, members of an object (in the order they were given). JsonError for one
  // that is not there, or of another kind of value.
  std::size_t size() const;
  bool empty() const { return size() == 0; }
  const Json& at(std::size_t n) const;
  const Json& at(const std::string& name) const;
  bool contains(const std::string& name) const { return find(name) != nullptr; }
  template <class T>
  T value(const std::string& name, T otherwise) const {
    const Json* found = find(name);
    return found == nullptr ? otherwise : found->get<T>();
  }
  const std::vector<Json>& entries() const;
  const std::vector<Member>& members() const;

  // These make an array or an object of null.
  void push_back(Json entry);
  Json& operator[](const std::string& name);

  // Numbers by value, objects whatever the order of their members.
  bool operator==(const Json& other) const;

 private:
  struct Scalar {
    bool boolean;
    std::int64_t value;
  };
  explicit Json(Scalar s);
  [[noreturn]] void refuse(const char* wanted) const;
  const Json* find(const std::string& name) const;
  bool boolean() const;
  double real() const;
  std::int64_t whole() const;
  const std::string& text() const;

  bool read(const bool*) const { return boolean(); }
  std::string read(const std::string*) const { return text(); }
  template <std::integral T>
  T read(const T*) const {
    return static_cast<T>(whole());
  }
  template <std::floating_point T>
  T read(const T*) const {
    return static_cast<T>(real());
  }
  template <class T>
  std::vector<T> read(const std::vector<T>*) const {
    std::vector<T> list;
    for (const Json& one : entries()) list.push_back(one.get<T>());
    return list;
  }
  template <class T, std::size_t N>
  std::array<T, N> read(const std::array<T, N>*) const {
    std::array<T, N> list;
    if (entries().size() != N) refuse("a list of another length");
    for (std::size_t n = 0; n < N; ++n) list[n] = entries()[n].template get<T>();
    return list;
  }

  Kind kind_ = Kind::null;
  std::int64_t whole_ = 0;  // and booleans
  double real_ = 0;
  std::string text_;
  std::vector<Json> entries_;
  std::vector<Member> members_;
};

}  // namespace sluice
