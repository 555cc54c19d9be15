// Text files with a fixed number of numbers a line, as points and triangles come; gzipped
// or not.
#pragma once
#include <functional>
#include <string>

namespace sluice {

// Calls row(numbers, line) for every line that is not blank. Blanks and commas separate; numbers
// beyond `columns` are ignored. InputError names the file and the line of what is wrong; a file
// without any row is wrong too.
void read_table(const std::string& file, int columns,
                const std::function<void(const double* numbers, int line)>& row);

}  // namespace sluice
