// Parameters: as they were written (ParamList, plain data) and as a plugin reads them (ParamReader). A plugin's factory
// asks the reader for each of its parameters with default, unit and a sentence; the same calls yield the object, the
// errors for unknown parameters, and the text of `dspm --describe`.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "dspm/base/colour/colour.h"
#include "dspm/base/colour/colour_space.h"
#include "dspm/base/colour/rgb.h"
#include "dspm/base/colour/spectral_curve.h"
#include "dspm/base/math/moments.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/params/errors.h"

namespace dspm {

enum class ParamType {
  boolean,
  integer,
  number,
  text,
  point2,
  vector2,
  point3,
  vector3,
  normal,
  rgb,
  blackbody,
  spectrum,
  texture
};

/// Returns the word for a type in scene text ("float" for number). param_type() reads it back; nullopt if the word is
/// unknown.
std::string_view word_of(ParamType type);
std::optional<ParamType> param_type(std::string_view word);

/// `"rgb reflectance@12" [1 0 0]`. Points, vectors, colours and sampled spectra are flat lists of numbers.
struct Param {
  using Values = std::variant<std::vector<float>, std::vector<int>, std::vector<std::string>, std::vector<bool>>;

  ParamType type = ParamType::number;
  std::string name;
  std::optional<Moment> key;  // after `@`; none: not keyed
  Values values;
  SourceLocation where;                   // of the quoted "type name"
  SourceLocation values_where;            // of the first value
  bool is_default = false;                // set by an Attribute directive: no error if unread
  ColourSpace space = ColourSpace::srgb;  // of an rgb value
};

/// Makes a parameter that no text holds; messages name `where` instead.
Param param_of(ParamType type, std::string name, Param::Values values, const SourceLocation& where);

/// The numbers of a numeric parameter, integers as floats.
std::vector<float> numbers_of(const Param& param);

/// The parameters of one directive.
struct ParamList {
  std::vector<Param> params;
  ColourSpace space = ColourSpace::srgb;  // in force where it was written: that of lights which give no colour

  const Param* find(std::string_view name) const;  // the first of that name, keyed or not
  /// Returns whether it has keyed parameters, or a file name with a frame number in it.
  bool is_keyed() const;
  /// Returns the list without keys: its values at that moment. Numbers, points and colours are interpolated linearly;
  /// everything else holds until the next key. `%03d` in a "filename" becomes the file's number ("first" + frame *
  /// "step", both 1 by default), which holds until the next whole frame.
  ParamList at(Moment moment) const;
  /// Compares types, names, keys, values and colour spaces, in any order of the parameters.
  bool same_values(const ParamList& other) const;
};

/// One parameter as `--describe` prints it.
struct ParamInfo {
  std::string type, name, default_value, unit, sentence;
  std::vector<std::string> choices = {};  // the only values that a text may take; empty: any
};

/// A parameter that is a constant, or the name of a texture.
template <class T>
struct ValueOrTexture {
  T value{};
  std::string texture;  // empty: the constant
  SourceLocation where;
  std::shared_ptr<const SpectrumByNm> spectrum = nullptr;  // of a constant colour, if it is given as one
};

/// A colour, and the spectrum that it is of if the scene gives one.
struct ColourOrSpectrum {
  Rgb colour;
  std::optional<SpectralCurve> spectrum;
};

/// Thrown by finish() if no object is wanted: in describe(), and after only_check().
struct DescribedEnough {};

class ParamReader {
 public:
  /// `subject` is how messages name the object: `material "diffuse"`. `list` must not be keyed: see ParamList::at.
  /// Files that are not next to the scene file that names them are looked for in `main_directory`, the main file's.
  ParamReader(const ParamList& list, std::string subject, SourceLocation where, Diagnostics& diagnostics,
              std::filesystem::path main_directory = {});
  /// Only describes: every read appends to `described` and returns its default; finish() throws DescribedEnough.
  ParamReader(std::vector<ParamInfo>& described, Diagnostics& diagnostics);

  /// From here on, finish() throws DescribedEnough after its checks: the parameters are checked, but no object is made.
  void only_check() { only_checks_ = true; }

  /// Returns whether the scene gives the parameter, by this name or an alias. Call it in addition to reading, not
  /// instead: a factory reads every parameter in every case, or --describe would miss some.
  bool has(std::string_view name) const;
  float number(std::string_view name, float fallback, std::string_view unit, std::string_view sentence);
  int integer(std::string_view name, int fallback, std::string_view unit, std::string_view sentence);
  bool flag(std::string_view name, bool fallback, std::string_view sentence);
  std::string text(std::string_view name, std::string fallback, std::string_view sentence);
  /// Reads one of `choices`; anything else is an error that lists them.
  std::string choice(std::string_view name, std::string fallback, const std::vector<std::string>& choices,
                     std::string_view sentence);
  Vec3 point(std::string_view name, Vec3 fallback, std::string_view unit, std::string_view sentence);
  Vec3 vector(std::string_view name, Vec3 fallback, std::string_view unit, std::string_view sentence);
  /// Reads a colour, given as rgb, spectrum, blackbody, or as one float for all of rgb. The result is in Rec. 709,
  /// whatever colour space the scene uses.
  Rgb rgb(std::string_view name, Rgb fallback, SpectrumRole role, std::string_view sentence);
  /// Reads a colour like rgb() above, and keeps the spectrum if it is given as one.
  Colour colour(std::string_view name, Rgb fallback, SpectrumRole role, std::string_view sentence);
  /// Reads a colour like rgb() above, but the default is a named spectrum such as "metal-Cu-eta".
  Rgb rgb(std::string_view name, std::string_view named_fallback, SpectrumRole role, std::string_view sentence);
  /// Returns the first illuminant that was read, null if it was no spectrum: the rgb that rgb() returned is its colour.
  std::shared_ptr<const SpectrumByNm> illuminant() const { return illuminant_.value_or(nullptr); }
  /// Reads a colour like rgb() above, and keeps the curve if it is given as a spectrum.
  ColourOrSpectrum colour_or_spectrum(std::string_view name, Rgb fallback, SpectrumRole role,
                                      std::string_view sentence);
  ValueOrTexture<float> number_or_texture(std::string_view name, float fallback, std::string_view unit,
                                          std::string_view sentence);
  ValueOrTexture<Rgb> rgb_or_texture(std::string_view name, Rgb fallback, SpectrumRole role, std::string_view sentence);
  ValueOrTexture<Rgb> rgb_or_texture(std::string_view name, std::string_view named_fallback, SpectrumRole role,
                                     std::string_view sentence);
  std::vector<float> numbers(std::string_view name, std::string_view sentence);
  std::vector<int> integers(std::string_view name, std::string_view sentence);
  /// Reads any number of colours, given as rgb; like rgb() above, in Rec. 709.
  std::vector<Rgb> colours(std::string_view name, SpectrumRole role, std::string_view sentence);
  std::vector<Vec2> points2(std::string_view name, std::string_view sentence);
  std::vector<Vec3> points3(std::string_view name, std::string_view sentence);  // point3, vector3 or normal
  std::vector<std::string> texts(std::string_view name, std::string_view sentence);
  /// Reads the path of a file, relative to the file that names it, else to the main file. A missing file is an error,
  /// and the path is empty.
  std::filesystem::path file(std::string_view name, std::string_view sentence);
  /// Reads the path of a file like file(); the path is empty if the scene names none.
  std::filesystem::path optional_file(std::string_view name, std::string_view sentence);
  /// Rejects a parameter that pbrt has and dspm does not: an error (a warning with --lenient) if the scene uses it. It
  /// is not described.
  void unsupported(std::string_view name, std::string_view what);
  /// Accepts a parameter that has no effect, here and in pbrt: a note if the scene gives it. It is not described.
  void without_effect(std::string_view name);
  /// Accepts another spelling: if the scene gives `alias`, it is read as `name`.
  void alias(std::string_view alias, std::string_view name);
  /// Accepts a name that is no longer used as `name`; a note says so.
  void former_name(std::string_view former, std::string_view name);

  /// Call it after the last read and before any work: parameters that were not read are errors ("did you mean").
  void finish();

  /// The location of a parameter (if not given, of the directive), for a plugin's own messages.
  SourceLocation where(std::string_view name) const;
  SourceLocation where() const { return where_; }
  void error(std::string_view name, std::string message, std::string hint = {});
  void warning(std::string_view name, std::string message, std::string hint = {});
  Diagnostics& diagnostics() { return diagnostics_; }
  /// The colour space in force where the directive was written.
  ColourSpace space() const { return list_ ? list_->space : ColourSpace::srgb; }
  const std::string& subject() const { return subject_; }

 private:
  using Types = std::vector<ParamType>;

  /// Returns the parameter in the list, or null; also null, after an error, if its type is not among `types`.
  const Param* take(std::string_view name, const Types& types, std::string default_value, std::string_view unit,
                    std::string_view sentence);
  /// Takes a parameter of exactly `count` values.
  const Param* take_some(std::string_view name, const Types& types, std::size_t count, std::string default_value,
                         std::string_view unit, std::string_view sentence);
  /// Takes a parameter of any number of groups of `size` numbers.
  std::vector<float> take_groups(std::string_view name, const Types& types, std::size_t size,
                                 std::string_view sentence);
  Vec3 triple(std::string_view name, const Types& types, Vec3 fallback, std::string_view unit,
              std::string_view sentence);
  ValueOrTexture<Rgb> take_colour(std::string_view name, const Colour& fallback, std::string default_value,
                                  SpectrumRole role, bool textures, std::string_view sentence);
  std::optional<Colour> colour_of(const Param& param, SpectrumRole role);
  std::optional<SpectralCurve> spectrum(const Param& param);
  std::optional<SpectralCurve> spectrum_from_file(const Param& param, const std::string& name);
  std::optional<SpectralCurve> spectrum_from_pairs(const Param& param, const std::vector<float>& pairs);
  std::filesystem::path take_file(std::string_view name, bool required, std::string_view sentence);
  /// Returns the files that `name` may mean, most likely first.
  std::vector<std::filesystem::path> places(const Param& param, const std::string& name) const;
  std::filesystem::path existing_file(const Param& param, const std::string& name) const;
  bool count_is(const Param& param, std::size_t count);

  const Param* find(std::string_view name) const;
  std::string_view canonical(std::string_view name) const;  // the name that an alias stands for, else the name
  std::string quoted(std::string_view name) const;
  std::string describe_hint() const;

  const ParamList* list_ = nullptr;
  std::string subject_;
  SourceLocation where_;
  Diagnostics& diagnostics_;
  std::filesystem::path main_directory_;
  std::vector<ParamInfo>* described_ = nullptr;
  bool only_checks_ = false;
  std::optional<std::shared_ptr<const SpectrumByNm>> illuminant_;
  std::vector<std::string> known_;                            // names that were read
  std::vector<std::string> tolerated_;                        // names that unsupported() has reported
  std::vector<std::pair<std::string, std::string>> aliases_;  // alias, name
};

}  // namespace dspm
