// Arithmetic on the columns of a property table: numbers, [column], {axis}, + - * / and brackets.
// Units are those of the table; nobody checks them.
#pragma once
#include <functional>
#include <string>

namespace sluice::models {

// What [name] or {name} stands for.
using ColumnLookup = std::function<double(const std::string& name, bool axis)>;

// InputError says where in the text it ends to be an expression.
double evaluate_expression(const std::string& text, const ColumnLookup& lookup);

}  // namespace sluice::models
