// The options of pictures: one table, declared for `sluice plot` and `sluice movie`, and handed on
// to the drawing program as they were given. A new option is a row of the table and a row of
// tools/sluice_tools/options.py.
#pragma once
#include <string>
#include <vector>

namespace sluice {

class Command;

enum class PictureCommand { plot = 1, movie = 2 };

class PictureOptions {
 public:
  PictureOptions();
  // The options that this command has; this object must live until the command runs.
  void declare(Command& command, PictureCommand which);
  // The values of an option, by its long name; of a flag that was given: one empty text.
  std::vector<std::string> values(const std::string& name) const;
  bool has(const std::string& name) const { return !values(name).empty(); }
  void set(const std::string& name, std::vector<std::string> values);
  // All that was given as words of a command line, but for the options that are named.
  std::vector<std::string> words(const std::vector<std::string>& without) const;

 private:
  enum class Kind { value, list, flag };
  struct Row {
    std::string name, names;  // the long name; all names
    Kind kind;
    int commands;  // PictureCommand, added up
    const char* text;
    std::vector<std::string> one_of = {};
    std::vector<std::string> values = {};
    bool on = false;
  };

  std::vector<Row> rows_;
};

}  // namespace sluice
