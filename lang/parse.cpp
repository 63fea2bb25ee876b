#include "dspm/lang/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "dspm/base/params/params.h"
#include "dspm/base/system/extension.h"
#include "dspm/base/system/inner_files.h"
#include "dspm/lang/directive.h"
#include "dspm/lang/gltf/translation.h"
#include "dspm/lang/old_pbrt.h"
#include "dspm/lang/scene_builder.h"
#include "dspm/lang/shape_run.h"
#include "dspm/lang/source_files.h"
#include "dspm/lang/v3/translator.h"
#include "dspm/lang/variations.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostIncludesDeep = 64;
constexpr int kMostIncludes = 50'000;  // in total: files that include one another twice would never end

/// Ends the reading: the scene is for an older pbrt.
struct OldScene {
  OldWord sign;
};

bool has_extension(fs::path name, std::string_view extension) {
  if (extension_of(name) == ".gz") name.replace_extension();
  return extension_of(name) == extension;
}

enum class Age { unknown, v4, v3 };

class SceneReader {
 public:
  SceneReader(SourceFiles& files, Age age, const ParseOptions& options, Diagnostics& diagnostics)
      : files_(files),
        options_(options),
        diagnostics_(diagnostics),
        builder_(scene_, diagnostics),
        age_(age),
        defines_(options.defines) {
    scene_.dialect = has_extension(files.main_name(), ".pbrt") ? Dialect::pbrt : Dialect::dsc;
    if (has_extension(files.main_name(), ".dsc") || gltf::is_gltf_name(files.main_name())) age_ = Age::v4;
  }

  void read_main(const std::string& path) {
    try {
      open_.push_back({path, identity_of(path)});
      const SourceFile& file = gltf::is_gltf_name(path) ? load_gltf(path, options_.gltf, {}) : files_.load(path);
      read(file);
      builder_.end_file(file);
    } catch (const std::runtime_error& error) {
      diagnostics_.error({}, fmt::format("cannot read \"{}\": {}", path, error.what()));
    }
    open_.pop_back();
  }

  SceneDescription finish() {
    scene_.files = files_.take();
    if (!scene_.files.empty() && !is_full()) builder_.finish();
    std::erase_if(scene_.axes,
                  [](const VariationAxis& axis) { return axis.variations.empty(); });  // after their errors
    scene_.frames = frames_of(scene_, options_.variations, options_.known, diagnostics_);
    if (diagnostics_.error_count() == 0)
      for (const auto& [name, value] : options_.defines)
        if (!is_used(name)) diagnostics_.warning({}, fmt::format("-D {}: the scene has no ${}", name, name));
    return std::move(scene_);
  }

  std::string summary() const { return translator_.summary(); }

 private:
  struct OpenFile {
    std::string name, identity;
  };

  bool is_used(const std::string& define) const {
    return std::any_of(scene_.files.begin(), scene_.files.end(),
                       [&](const auto& file) { return refers_to(file->text, define); });
  }
  bool is_full() const { return diagnostics_.error_count() >= kErrorsShown; }

  OldTypes old_types() const {
    return age_ == Age::v4 ? OldTypes::synonyms : age_ == Age::v3 ? OldTypes::v3 : OldTypes::errors;
  }

  void read(const SourceFile& file) {
    const SourceText whole(file);
    for (const TextPart& part : parts_of(whole.text())) read(whole, part);
  }

  void read(const SourceText& whole, const TextPart& part) {
    const auto source = std::make_shared<const SourceText>(whole, part, defines_, diagnostics_);
    Lexer lexer(*source);
    while (!is_full()) {
      try {
        const char* const begin = lexer.rest().data();
        auto directive = read_directive(lexer, old_types(), scene_.clock());
        if (!directive) break;
        carry_out(*std::move(directive), whole.file());
        if (ShapeUse* first = builder_.repeatable()) read_run(*first, source, begin, lexer);
      } catch (const SyntaxError& error) {
        if (age_ == Age::v3 && error.old_word == "WorldEnd") continue;
        if (!error.old_word.empty() && age_ != Age::v4) throw OldScene{{error.old_word, error.where}};
        diagnostics_.error(error.where, error.what(), error.hint);
        lexer.skip_to_directive();
      }
    }
  }

  /// Reads a run of directives that repeat `first`, which begins at `begin`.
  static void read_run(ShapeUse& first, const std::shared_ptr<const SourceText>& source, const char* begin,
                       Lexer& lexer) {
    const std::string_view rest = lexer.rest();
    if (!rest.starts_with("Shape")) return;
    auto run = ShapeRun::after(first, source, {begin, static_cast<std::size_t>(rest.data() - begin)});
    if (!run) return;
    lexer.go_on_at(run->read(rest.data()));
    if (run->count() > 0) first.run = std::make_shared<const ShapeRun>(*std::move(run));
  }

  void carry_out(Directive directive, const SourceFile& file) {
    if (age_ == Age::unknown && is_certainly_new(directive)) age_ = Age::v4;
    if (age_ != Age::v4)
      if (const auto word = old_word_in(directive); word && (age_ == Age::unknown || is_before_v3(*word)))
        throw OldScene{*word};
    const DirectiveKind kind = directive.info->kind;
    if (kind == DirectiveKind::default_value) return set_default(directive);
    if (kind != DirectiveKind::include && kind != DirectiveKind::import) return apply(std::move(directive));
    const SourceFile& included = open(directive, file);
    if (kind == DirectiveKind::import) builder_.begin_import(directive);
    read(included);
    if (kind == DirectiveKind::import)
      builder_.end_import();
    else
      builder_.end_file(included);
    open_.pop_back();
  }

  /// Sets a default. The first value holds: that of -D, or of a file that includes this one.
  void set_default(const Directive& directive) {
    const Argument &name = directive.words[0], &value = directive.words[1];
    if (!is_define_name(name.text))
      throw SyntaxError(name.where, fmt::format("\"{}\" cannot be the name of a value", name.text),
                        "names consist of letters, digits and _");
    if (find_directive(value.text) != nullptr)
      throw SyntaxError(directive.where, fmt::format("Default {} has no value", name.text),
                        fmt::format("Default {} 1", name.text));
    defines_.emplace(name.text, value.text);
  }

  void apply(Directive directive) {
    if (age_ != Age::v3) return builder_.apply(std::move(directive));
    const bool ends_header = is_header_ && directive.info->kind == DirectiveKind::world_begin;
    std::vector<Directive> translated = translate(std::move(directive));
    if (!is_header_) return apply_all(std::move(translated));
    header_.push_back(std::move(translated));
    if (!ends_header) return;
    translator_.settle(header_);
    is_header_ = false;
    for (std::vector<Directive>& group : header_) apply_all(std::move(group));
  }

  std::vector<Directive> translate(Directive directive) {
    try {
      return translator_.translate(std::move(directive));
    } catch (const v3::NoCounterpart& error) {
      diagnostics_.unsupported(error.where, error.what(), error.hint);
      return std::move(error.instead);
    }
  }

  /// Applies directives, each of which reports its own error.
  void apply_all(std::vector<Directive> directives) {
    for (Directive& directive : directives) try {
        builder_.apply(std::move(directive));
      } catch (const SyntaxError& error) {
        diagnostics_.error(error.where, error.what(), error.hint);
      }
  }

  const SourceFile& open(const Directive& directive, const SourceFile& file) {
    const Argument& name = directive.words[0];
    const fs::path path = files_.find(name.text, file);
    const std::string id = identity_of(path);
    check_cycle(name, id);
    if (open_.size() == kMostIncludesDeep)
      throw SyntaxError(name.where, fmt::format("Include and Import are nested more than {} deep", kMostIncludesDeep));
    if (++includes_ > kMostIncludes)
      throw SyntaxError(name.where, fmt::format("more than {} files are included", kMostIncludes));
    if (const std::size_t bytes = files_.excessive_repeats(); bytes > 0)
      throw SyntaxError(name.where, fmt::format("including the same files repeatedly adds up to {} MiB", bytes >> 20),
                        "ObjectBegin defines shapes once, and ObjectInstance places them as often as needed");
    try {
      const SourceFile& included = gltf::is_gltf_name(path)
                                       ? load_gltf(path.string(), gltf_settings(directive, id), name.where)
                                       : load_text(path.string(), directive);
      open_.push_back({path.string(), id});
      return included;
    } catch (const std::runtime_error& error) {
      throw SyntaxError(name.where, fmt::format("cannot read \"{}\": {}", path.string(), error.what()));
    }
  }

  const SourceFile& load_text(const std::string& path, const Directive& directive) {
    if (!directive.params.params.empty())
      throw SyntaxError(directive.params.params.front().where,
                        fmt::format("{} takes parameters for glTF files alone", directive.info->name));
    return files_.load(path);
  }

  /// Returns the settings for a glTF file: before WorldBegin it is a whole scene, after it a part of this one.
  gltf::Settings gltf_settings(const Directive& directive, const std::string& id) {
    gltf::Settings settings = options_.gltf;
    ParamReader reader(directive.params, std::string(directive.info->name), directive.where, diagnostics_);
    settings.animation = reader.text("animation", settings.animation,
                                     "its name; by default the first, and those that move other things");
    reader.finish();
    if (!builder_.world_has_begun()) return settings;
    settings.around = gltf::Around{scene_.moments, scene_.fps};
    settings.is_defined = !parts_.insert(id).second;
    return settings;
  }

  /// Returns the file as scene text; its meshes and pictures are files within it.
  const SourceFile& load_gltf(const std::string& path, const gltf::Settings& settings, const SourceLocation& where) {
    const fs::path file(path);
    gltf::Translation translation = gltf::translate(file, file.filename().string(), settings);
    for (auto& [name, bytes] : translation.files)
      offer_inner_file(file.parent_path() / name, std::move(bytes), std::move(translation.files_later[name]));
    files_.put(path, std::move(translation.text));
    for (const std::string& note : translation.notes) diagnostics_.note(where, fmt::format("{}: {}", path, note));
    return files_.load(path);
  }

  void check_cycle(const Argument& name, const std::string& id) const {
    const auto first =
        std::find_if(open_.begin(), open_.end(), [&](const OpenFile& file) { return file.identity == id; });
    if (first == open_.end()) return;
    std::string cycle;
    for (auto file = first; file != open_.end(); ++file) cycle += file->name + " -> ";
    throw SyntaxError(name.where, "this file includes itself", cycle + first->name);
  }

  SourceFiles& files_;
  const ParseOptions& options_;
  Diagnostics& diagnostics_;
  SceneDescription scene_;
  SceneBuilder builder_;
  Age age_;
  Defines defines_;
  v3::Translator translator_;
  v3::Header header_;  // of a v3 scene, before WorldBegin
  bool is_header_ = true;
  std::vector<OpenFile> open_;
  int includes_ = 0;
  std::set<std::string> parts_;  // glTF files that have been imported, by identity
};

void pass_on(const Diagnostic& diagnostic, Diagnostics& diagnostics) {
  switch (diagnostic.severity) {
    case Severity::error: return diagnostics.error(diagnostic.where, diagnostic.message, diagnostic.hint);
    case Severity::warning: return diagnostics.warning(diagnostic.where, diagnostic.message, diagnostic.hint);
    case Severity::note: return diagnostics.note(diagnostic.where, diagnostic.message, diagnostic.hint);
  }
}

/// Reads the files from the start. `sign` is that of a v3 scene; null if none is known.
SceneDescription read_all(SourceFiles& files, const std::vector<std::string>& paths, const OldWord* sign,
                          const ParseOptions& options, Diagnostics& diagnostics) {
  Diagnostics found(diagnostics.lenient());
  files.start_again();
  SceneReader reader(files, sign != nullptr ? Age::v3 : Age::unknown, options, found);
  for (const std::string& path : paths) reader.read_main(path);
  SceneDescription scene = reader.finish();
  if (sign != nullptr) diagnostics.note(sign->where, reader.summary());
  for (const Diagnostic& each : found.all()) pass_on(each, diagnostics);
  return scene;
}

SceneDescription parse(SourceFiles& files, const std::vector<std::string>& paths, const ParseOptions& options,
                       Diagnostics& diagnostics) {
  try {
    try {
      return read_all(files, paths, nullptr, options, diagnostics);
    } catch (const OldScene& old) {
      if (is_before_v3(old.sign)) throw;
      return read_all(files, paths, &old.sign, options, diagnostics);
    }
  } catch (const OldScene& old) {
    const SyntaxError error = old_pbrt_error(old.sign);
    diagnostics.error(error.where, error.what(), error.hint);
    SceneDescription nothing;  // the elements read so far would only cause more messages
    nothing.files = files.take();
    return nothing;
  }
}

}  // namespace

SceneDescription parse_files(const std::vector<std::string>& paths, const ParseOptions& options,
                             Diagnostics& diagnostics) {
  SourceFiles files(paths.empty() ? "" : paths.front());
  return parse(files, paths, options, diagnostics);
}

SceneDescription parse_text(const std::string& name, std::string text, const ParseOptions& options,
                            Diagnostics& diagnostics) {
  SourceFiles files(name);
  try {
    files.put(name, std::move(text));
  } catch (const std::runtime_error& error) {
    diagnostics.error({}, fmt::format("cannot read \"{}\": {}", name, error.what()));
    return parse(files, {}, options, diagnostics);
  }
  return parse(files, {name}, options, diagnostics);
}

}  // namespace dspm
