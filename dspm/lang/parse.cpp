#include "dspm/lang/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "dspm/lang/directive.h"
#include "dspm/lang/old_pbrt.h"
#include "dspm/lang/scene_builder.h"
#include "dspm/lang/variations.h"
#include "dspm/system/file_access.h"
#include "dspm/system/read_file.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostIncludesDeep = 64;
constexpr int kMostIncludes = 50'000;  // in total: files that include one another twice would never end
// Text may be read again up to this size, or up to this many times the size of all text read once. Otherwise a megabyte
// included often would fill the memory.
constexpr std::size_t kMostRepeated = std::size_t{2} << 20, kMostRepeats = 4;

/// Ends the reading: one message is enough.
struct OldScene {
  SyntaxError error;
};

bool has_extension(std::string name, std::string_view extension) {
  if (name.ends_with(".gz")) name.resize(name.size() - 3);
  return name.ends_with(extension);
}

/// Two names of the same file have the same identity.
std::string identity(const fs::path& path) {
  std::error_code error;
  const fs::path canonical = fs::weakly_canonical(path, error);
  return (error ? path : canonical).string();
}

class SceneReader {
 public:
  SceneReader(const std::string& main_name, const ParseOptions& options, Diagnostics& diagnostics)
      : options_(options), diagnostics_(diagnostics), builder_(scene_, diagnostics), main_name_(main_name) {
    scene_.dialect = has_extension(main_name, ".pbrt") ? Dialect::pbrt : Dialect::dsc;
    is_new_ = has_extension(main_name, ".dsc");
  }

  void read_main(const std::string& path) {
    try {
      open_.push_back({path, identity(path)});
      read(path == "-" ? own("standard input", read_input(path)) : load(path, path));
    } catch (const std::runtime_error& error) {
      diagnostics_.error({}, fmt::format("cannot read \"{}\": {}", path, error.what()));
    }
    open_.pop_back();
  }

  void read_text(std::string text) {
    open_.push_back({main_name_, identity(main_name_)});
    read(own(main_name_, std::move(text)));
  }

  void finish() {
    if (!scene_.files.empty() && !is_full()) builder_.finish();
    std::erase_if(scene_.axes,
                  [](const VariationAxis& axis) { return axis.variations.empty(); });  // after their errors
    scene_.frames = frames_of(scene_, options_.variations, diagnostics_);
    if (diagnostics_.error_count() > 0) return;
    for (const auto& [name, value] : options_.defines)
      if (!is_used(name)) diagnostics_.warning({}, fmt::format("-D {}: the scene has no ${}", name, name));
  }

  SceneDescription take_scene() { return std::move(scene_); }

 private:
  struct OpenFile {
    std::string name, identity;
  };

  bool is_used(const std::string& define) const {
    return std::any_of(scene_.files.begin(), scene_.files.end(),
                       [&](const auto& file) { return refers_to(file->text, define); });
  }
  bool is_full() const { return diagnostics_.error_count() >= kErrorsShown; }

  const SourceFile& own(std::string name, std::string text) {
    scene_.files.push_back(std::make_unique<SourceFile>(SourceFile{std::move(name), std::move(text)}));
    return *scene_.files.back();
  }

  /// A file that is included often is read once.
  const SourceFile& load(const std::string& name, const fs::path& path) {
    const SourceFile*& file = loaded_[identity(path)];
    if (file != nullptr) {
      repeated_ += file->text.size();
    } else {
      file = &own(name, read_file(path));
      read_once_ += file->text.size();
    }
    return *file;
  }

  void read(const SourceFile& file) {
    const SourceText source(file, options_.defines, diagnostics_);
    Lexer lexer(source);
    while (!is_full()) {
      try {
        auto directive = read_directive(lexer, is_new_);
        if (!directive) break;
        carry_out(*std::move(directive), file);
      } catch (const SyntaxError& error) {
        if (!error.old_word.empty() && !is_new_) throw OldScene{old_pbrt_error({error.old_word, error.where})};
        diagnostics_.error(error.where, error.what(), error.hint);
        lexer.skip_to_directive();
      }
    }
  }

  void carry_out(Directive directive, const SourceFile& file) {
    is_new_ = is_new_ || is_certainly_new(directive);
    if (!is_new_)
      if (const auto word = old_word_in(directive)) throw OldScene{old_pbrt_error(*word)};
    const DirectiveKind kind = directive.info->kind;
    if (kind != DirectiveKind::include && kind != DirectiveKind::import) return builder_.apply(std::move(directive));
    const SourceFile& included = open(directive.words[0], file);
    if (kind == DirectiveKind::import) builder_.begin_import(directive);
    read(included);
    if (kind == DirectiveKind::import) builder_.end_import();
    open_.pop_back();
  }

  const SourceFile& open(const Argument& name, const SourceFile& file) {
    const fs::path path = find(name.text, file);
    const std::string id = identity(path);
    check_cycle(name, id);
    if (open_.size() == kMostIncludesDeep)
      throw SyntaxError(name.where, fmt::format("Include and Import are nested more than {} deep", kMostIncludesDeep));
    if (++includes_ > kMostIncludes)
      throw SyntaxError(name.where, fmt::format("more than {} files are included", kMostIncludes));
    if (repeated_ > kMostRepeated && repeated_ / kMostRepeats > read_once_)
      throw SyntaxError(name.where,
                        fmt::format("including the same files repeatedly adds up to {} MiB", repeated_ >> 20),
                        "ObjectBegin defines shapes once, and ObjectInstance places them as often as needed");
    try {
      const SourceFile& included = load(path.string(), path);
      open_.push_back({path.string(), id});
      return included;
    } catch (const std::runtime_error& error) {
      throw SyntaxError(name.where, fmt::format("cannot read \"{}\": {}", path.string(), error.what()));
    }
  }

  /// Next to the file that names it, else next to the main file.
  fs::path find(const std::string& name, const SourceFile& file) const {
    const fs::path beside = fs::path(file.name).parent_path() / name;
    const fs::path beside_main = fs::path(main_name_).parent_path() / name;
    const bool is_beside_main = !seems_to_exist(beside) && seems_to_exist(beside_main);
    return (is_beside_main ? beside_main : beside).lexically_normal();
  }

  void check_cycle(const Argument& name, const std::string& id) const {
    const auto first =
        std::find_if(open_.begin(), open_.end(), [&](const OpenFile& file) { return file.identity == id; });
    if (first == open_.end()) return;
    std::string cycle;
    for (auto file = first; file != open_.end(); ++file) cycle += file->name + " -> ";
    throw SyntaxError(name.where, "this file includes itself", cycle + first->name);
  }

  const ParseOptions& options_;
  Diagnostics& diagnostics_;
  SceneDescription scene_;
  SceneBuilder builder_;
  std::string main_name_;
  bool is_new_ = false;  // certainly not for an older pbrt
  std::vector<OpenFile> open_;
  std::map<std::string, const SourceFile*> loaded_;
  int includes_ = 0;
  std::size_t read_once_ = 0, repeated_ = 0;  // bytes
};

void pass_on(const Diagnostic& diagnostic, Diagnostics& diagnostics) {
  switch (diagnostic.severity) {
    case Severity::error: return diagnostics.error(diagnostic.where, diagnostic.message, diagnostic.hint);
    case Severity::warning: return diagnostics.warning(diagnostic.where, diagnostic.message, diagnostic.hint);
    case Severity::note: return diagnostics.note(diagnostic.where, diagnostic.message, diagnostic.hint);
  }
}

template <class Read>
SceneDescription parse(const std::string& main_name, const ParseOptions& options, Diagnostics& diagnostics, Read read) {
  Diagnostics found(diagnostics.lenient());
  SceneReader reader(main_name, options, found);
  try {
    read(reader);
    reader.finish();
    for (const Diagnostic& each : found.all()) pass_on(each, diagnostics);
  } catch (const OldScene& old) {
    diagnostics.error(old.error.where, old.error.what(), old.error.hint);
    SceneDescription nothing;  // the elements read so far would only cause more messages
    nothing.files = std::move(reader.take_scene().files);
    return nothing;
  }
  return reader.take_scene();
}

}  // namespace

SceneDescription parse_files(const std::vector<std::string>& paths, const ParseOptions& options,
                             Diagnostics& diagnostics) {
  return parse(paths.empty() ? "" : paths.front(), options, diagnostics, [&](SceneReader& reader) {
    for (const std::string& path : paths) reader.read_main(path);
  });
}

SceneDescription parse_text(const std::string& name, std::string text, const ParseOptions& options,
                            Diagnostics& diagnostics) {
  return parse(name, options, diagnostics, [&](SceneReader& reader) { reader.read_text(std::move(text)); });
}

}  // namespace dspm
