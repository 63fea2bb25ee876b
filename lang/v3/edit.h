// One directive of pbrt-v3 on its way to pbrt-v4: its type and parameters, as the tables of this folder change them.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dspm/base/colour/rgb.h"
#include "dspm/base/params/params.h"
#include "dspm/lang/directive.h"

namespace dspm::v3 {

/// The losses of a translation, for the one line that reports them.
struct Remarks {
  std::set<std::string> only_close;  // `plastic`, `sigma of matte`
  std::set<std::string> unknown;     // parameters that v3 did not know either, and ignored
};

/// Thrown for what v4 has nothing like.
class NoCounterpart : public SyntaxError {
 public:
  NoCounterpart(const Directive& directive, std::string_view kind, const std::string& type, const std::string& way_out);

  std::vector<Directive> instead;  // what stands in with --lenient
};

/// `words` are separated by blanks. `old=new` renames a parameter, `old=` drops one that changes nothing, `old!` one
/// that v4 lacks; a plain word keeps it. `:type value` after a name adds it if it is missing: "roughness:float 0.1" is
/// written `roughness:float.1`. Parameters without a word are dropped, as v3 did.
struct Rule {
  std::string_view from, to;  // types; `to` empty: as it was
  std::string_view words;
};

class Edit {
 public:
  Edit(Directive& directive, Remarks& remarks) : directive_(directive), remarks_(remarks) {}

  std::string type() const;
  void set_type(std::string_view type);
  /// Returns the name of the material or texture that it defines; empty if it defines none.
  std::string name() const;
  const SourceLocation& where() const { return directive_.where; }

  /// Applies a rule. "type" of a MakeNamed... directive is no parameter here.
  void apply(const Rule& rule);

  const Param* find(std::string_view name) const { return directive_.params.find(name); }
  std::optional<Param> take(std::string_view name);
  std::string take_text(std::string_view name);
  bool take_flag(std::string_view name, bool fallback);
  /// Returns the name of the parameter's texture; empty if it is not a texture.
  std::string texture(std::string_view name) const;
  /// Returns its value, if it is one number or one rgb colour.
  std::optional<Rgb> constant(std::string_view name) const;
  std::optional<float> number(std::string_view name) const;

  void set(ParamType type, std::string name, Param::Values values);
  void set_number(std::string name, float value) { set(ParamType::number, std::move(name), std::vector{value}); }
  void set_rgb(std::string name, const Rgb& c) { set(ParamType::rgb, std::move(name), std::vector{c.r, c.g, c.b}); }

  /// Remarks that `what` is translated, but does not look quite the same.
  void only_close(std::string what) { remarks_.only_close.insert(std::move(what)); }

  /// Remarks that v4 does not know `what`, nor did v3, which ignored it.
  void not_known(std::string what) { remarks_.unknown.insert(std::move(what)); }

  /// Puts a directive before this one.
  void before(Directive directive) { before_.push_back(std::move(directive)); }
  bool is_before(std::string_view defined) const;  // one that defines this name
  void after(Directive directive) { after_.push_back(std::move(directive)); }
  std::vector<Directive> take_before() { return std::move(before_); }
  std::vector<Directive> take_after() { return std::move(after_); }
  /// Makes a directive without parameters, at this one's place.
  Directive make(std::string_view name, const std::vector<std::string>& words) const;

  Directive& directive() { return directive_; }

 private:
  struct Word;
  void apply(const Word& word);

  Directive& directive_;
  Remarks& remarks_;
  std::vector<Directive> before_, after_;
};

}  // namespace dspm::v3
