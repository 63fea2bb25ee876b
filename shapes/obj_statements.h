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
  /// Takes plain_text(), of which it keeps a reference.
  explicit ObjStatements(std::string_view text) : left_(text) {}
  /// Returns nullopt at the end. Skips comments and empty lines; a \ at a line's end continues the statement.
  std::optional<ObjStatement> next();

 private:
  std::string_view next_line();

  std::string_view left_;
  std::string joined_;  // of several lines
  int lines_ = 0;
};

/// Takes the next word from the front of the text; empty at its end.
std::string_view next_word(std::string_view& text);
/// Takes the next word, like next_word(), but a comment ends the words.
std::string_view next_value(std::string_view& text);
/// Returns a finite number; what is too small for a float is 0.
std::optional<float> obj_number(std::string_view word);

/// Returns the likeliest spellings of a file name that was written elsewhere: as it is, without quotes, and with / for
/// \. The likeliest is first, each comes once.
std::vector<std::string> spellings_of(std::string_view name);
/// Returns such a name without the folders of that machine.
std::string without_folders(std::string_view name);

}  // namespace dspm
