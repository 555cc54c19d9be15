// Formulas of x, y, z that decks use for initial states, evaluated by muParser.
#include "framework/scene/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <numbers>

#include "framework/base/error.hpp"

namespace sluice {

struct Formula::Engine {
  mu::Parser parser;
  double x = 0, y = 0, z = 0;
};

namespace {

// `at` counts from 0; negative: no place is known.
[[noreturn]] void fail(const std::string& text, int at, const std::string& what) {
  std::string message = fmt::format("formula: {}", what);
  if (at < 0) throw InputError(fmt::format("{}: '{}'", message, text));
  message += fmt::format(" at character {}\n  {}\n  {}^", at + 1, text, std::string(at, ' '));
  throw InputError(message);
}

// muParser would take a single '=' for an assignment to x.
void refuse_assignment(const std::string& text) {
  const std::string_view before = "=<>!";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool second = i > 0 && before.find(text[i - 1]) != std::string_view::npos;
    const bool first = i + 1 < text.size() && text[i + 1] == '=';
    if (!second && !first) fail(text, static_cast<int>(i), "'=' does not compare; write '=='");
    if (first) ++i;
  }
}

double floor_of(double a) {
  return std::floor(a);
}
double ceil_of(double a) {
  return std::ceil(a);
}

}  // namespace

Formula::Formula(const std::string& text, const std::map<std::string, double>& constants)
    : text_(text), engine_(std::make_unique<Engine>()) {
  if (text.find_first_not_of(" \t\n") == std::string::npos) fail(text, -1, "no expression");
  refuse_assignment(text);
  Engine& e = *engine_;
  try {
    e.parser.DefineVar("x", &e.x);
    e.parser.DefineVar("y", &e.y);
    e.parser.DefineVar("z", &e.z);
    e.parser.DefineConst("pi", std::numbers::pi);
    e.parser.DefineConst("e", std::numbers::e);
    e.parser.DefineFun("floor", floor_of);
    e.parser.DefineFun("ceil", ceil_of);
    for (const auto& [name, value] : constants) e.parser.DefineConst(name, value);
    e.parser.SetExpr(text);
    int results = 0;
    e.parser.Eval(results);
    if (results != 1)
      fail(text, -1, fmt::format("{} values separated by commas where one is expected", results));
  } catch (const mu::Parser::exception_type& error) {
    const bool placed = error.GetCode() != mu::ecUNEXPECTED_EOF && error.GetPos() >= 0 &&
                        error.GetPos() <= static_cast<int>(text.size());
    const std::string token = error.GetToken();
    fail(text, placed ? error.GetPos() : static_cast<int>(text.size()),
         error.GetCode() == mu::ecUNASSIGNABLE_TOKEN
             ? fmt::format("'{}' is not a variable, constant or function", token)
         : error.GetCode() == mu::ecUNEXPECTED_EOF ? "the expression ends too early"
                                                   : error.GetMsg());
  }
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;

double Formula::operator()(Vec3 p) const {
  engine_->x = p.x;
  engine_->y = p.y;
  engine_->z = p.z;
  return engine_->parser.Eval();
}

}  // namespace sluice
