// The statements of OBJ and MTL files, one after the other.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dspm {

/// Views into the text, or into what ObjStatements holds until it is asked for the next.
struct ObjStatement {
  std::string_view text, keyword;
  std::string_view rest;  // after the keyword, without blanks around it
  int line;               // where it begins
};

class ObjStatements {
 public:
  /// Of plain_text(), which is kept by reference.
  explicit ObjStatements(std::string_view text) : left_(text) {}
  /// Nullopt at the end. Comments and empty lines are none; a \ at a line's end continues the statement.
  std::optional<ObjStatement> next();

 private:
  std::string_view next_line();

  std::string_view left_;
  std::string joined_;  // of several lines
  int lines_ = 0;
};

/// Takes the next word from the front of the text; empty at its end.
std::string_view next_word(std::string_view& text);
/// Likewise, where a comment ends the words.
std::string_view next_value(std::string_view& text);
/// A finite number of that text; what is too small for a float is 0.
std::optional<float> obj_number(std::string_view word);

/// File names as written elsewhere: themselves, without quotes, and with / for \. The likeliest first, each once.
std::vector<std::string> spellings_of(std::string_view name);
/// Such a name without the folders of that machine.
std::string without_folders(std::string_view name);

}  // namespace dspm
