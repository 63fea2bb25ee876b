// Locations in scene files, and messages about them. Every mistake of a user becomes a Diagnostic; all of a scene's
// diagnostics are shown at once.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dspm {

/// A scene file's name and its whole text, kept so that a message can show the line. Owned by the SceneDescription.
struct SourceFile {
  std::string name;
  std::string text;
};

/// Lines and columns count from 1; `length` characters are underlined. `file` is null if the place is unknown.
struct SourceLocation {
  const SourceFile* file = nullptr;
  int line = 0, column = 0, length = 1;
};

/// At most this many errors of a scene are shown; a parser may stop after them.
inline constexpr int kErrorsShown = 20;

enum class Severity { note, warning, error };

struct Diagnostic {
  Severity severity;
  SourceLocation where;
  std::string message;
  std::string hint;  // a way out; may be empty
};

/// The text shown to the user: file:line:column, the line, a caret, the hint.
std::string to_string(const Diagnostic& diagnostic);

/// Up to three of `candidates` that `word` may be a misspelling of, nearest first.
std::vector<std::string> nearest_names(std::string_view word, const std::vector<std::string>& candidates);
/// `did you mean "reflectance"?`, or an empty string if no candidate is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// The scene cannot be rendered; what() holds the error messages.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The request makes no sense or does not fit the scene; from a command line, exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Collects the errors in a scene. With `lenient`, unsupported features are warnings instead.
class Diagnostics {
 public:
  explicit Diagnostics(bool lenient = false) : lenient_(lenient) {}

  void error(const SourceLocation& where, std::string message, std::string hint = {});
  void warning(const SourceLocation& where, std::string message, std::string hint = {});
  void note(const SourceLocation& where, std::string message, std::string hint = {});
  /// Reports something valid that dspm does not support: an error, or a warning with --lenient.
  void unsupported(const SourceLocation& where, std::string message, std::string hint = {});

  /// Appends the diagnostics of a part to those that are already here.
  void append(Diagnostics part);

  int error_count() const { return errors_; }
  bool lenient() const { return lenient_; }
  const std::vector<Diagnostic>& all() const { return all_; }
  /// If there are errors, throws SceneError with the text of the first 20.
  void throw_if_errors() const;

 private:
  void add(Severity severity, const SourceLocation& where, std::string message, std::string hint);

  bool lenient_;
  int errors_ = 0;
  std::vector<Diagnostic> all_;
};

}  // namespace dspm
