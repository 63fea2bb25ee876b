#include "dspm/session/checkpoint/facts.h"

#include <fmt/format.h>

#include <deque>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "dspm/base/math/moments.h"
#include "dspm/base/system/files_read.h"
#include "dspm/base/system/version.h"
#include "dspm/integrators/guiding/file_sample.h"
#include "dspm/integrators/output_info.h"
#include "dspm/lang/canonical.h"
#include "dspm/session/checkpoint/part_of_scene.h"

namespace dspm {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFacts = 10'000'000, kMostText = 1 << 20;

Fact digest_fact(std::string name, std::uint64_t digest, const SourceLocation& where = {}) {
  return {std::move(name), fmt::format("{:016x}", digest), true, {}, {}, where};
}

std::uint64_t sensor_digest(const Sensor& sensor) {
  const auto bytes = std::as_bytes(sensor.parts_of_white());
  return digest({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void add_settings(const Job& job, std::vector<Fact>& facts) {
  const RenderSettings& s = job.settings;
  const PixelRect& crop = s.crop;
  facts.push_back({"the version of dspm", std::string(kVersion)});
  facts.push_back({"the image", fmt::format("{} x {} pixels", s.width, s.height)});
  facts.push_back(
      {"the crop window", fmt::format("x from {} to {}, y from {} to {}", crop.x0, crop.x1, crop.y0, crop.y1)});
  facts.push_back({"the seed", std::to_string(s.seed)});
  if (s.independent_numbers) facts.push_back({"the random numbers (Sampler, Option \"numbers\")", "independent"});
  if (s.spectral) facts.push_back({"the colours (--colour)", "spectral"});
  if (s.spectral && job.film.sensor != nullptr)
    facts.push_back(digest_fact("the film's sensor", sensor_digest(*job.film.sensor)));
  if (s.noise_per_frame) facts.push_back({"the noise (--noise)", "perframe"});
  const std::set<std::string> outputs(s.outputs.begin(), s.outputs.end());
  const char* space = s.in_camera_space ? "camera" : "world";
  facts.push_back({"the choice of outputs (--aov, --denoise)",
                   outputs.empty() ? kRadiance : fmt::format("{} in {} space", fmt::join(outputs, ","), space)});
  if (s.transparent) facts.push_back({"the background", "transparent"});
  facts.push_back({"pixel jitter", s.jitter ? "on" : "off"});
  if (job.shutter.delays())
    facts.push_back({"the shutter", fmt::format("open from {} to {}", job.shutter.open, job.shutter.close)});
  facts.push_back({"texture filtering", s.filter_textures ? "on" : "off"});
  if (const float scale = job.description->options.displacement_edge_scale; scale != 1)
    facts.push_back({"the scale of displaced edges", fmt::format("{}", scale)});
  facts.push_back({"the integrator", job.integrator});
  facts.push_back(digest_fact(fmt::format("integrator \"{}\"", job.integrator),
                              digest_of(job.integrator, job.params, {"iterations", "noise", "seed"}), job.where));
  static const PluginUse kUsual{kUsualPixelFilter, {}, {}, {}};
  const PluginUse& filter = job.description->filter ? *job.description->filter : kUsual;
  facts.push_back(digest_fact("the pixel filter", digest_of(filter.type, filter.params), filter.where));
  if (s.file != nullptr && s.file->given()) facts.push_back(digest_fact("the guide (--guide)", *s.file->given()));
}

/// Adds the order of the elements, which decides ties and how lights are chosen.
void add_order(const std::vector<ElementDigest>& elements, const PartOfScene& part, std::vector<Fact>& facts) {
  std::string names;
  for (const ElementDigest& element : elements)
    if (part.places(element)) names += element.name + "\n";
  facts.push_back(digest_fact("the order of the scene's parts", digest(names)));
}

/// Adds which Dynamic blocks each variation of the product has, at each moment; a block that no frame has leaves no
/// trace.
void add_presence(const SceneDescription& description, const PartOfScene& part,
                  const std::vector<ElementDigest>& elements, const FramesPart& frames, std::vector<Fact>& facts) {
  std::vector<std::string> present(static_cast<std::size_t>(frames.combinations));
  for (const ElementDigest& element : elements)
    if (element.kind == ElementDigest::Kind::block)
      part.for_each_with(element, [&](FileFrame f) {
        present[description.frames.combination_of(f)] +=
            fmt::format("{} {:x} {}\n", element.name, element.digest, description.frames.moment_index(f));
      });
  for (std::size_t c = 0; c < present.size(); ++c) {
    const std::string& name = description.frames.combinations()[c].name;
    facts.push_back(digest_fact(
        name.empty() ? "which Dynamic blocks are there" : fmt::format("which Dynamic blocks are there in \"{}\"", name),
        digest(present[c])));
    if (!name.empty()) facts.back().scope = Fact::Scope::combination, facts.back().of = name;
  }
}

/// Returns the name as the scene writes it, so that its folder may be moved.
fs::path short_name(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return relative.empty() || *relative.begin() == ".." ? file : relative;
}

/// Adds the files, except for the scene's text, of which only the meaning counts.
void add_files(const SceneDescription& description, bool may_be_new, std::vector<Fact>& facts) {
  std::set<fs::path> texts;
  std::error_code ignored;
  for (const auto& file : description.files) texts.insert(fs::canonical(file->name, ignored));
  const fs::path folder = fs::weakly_canonical(description.main_directory(), ignored);
  for (const auto& [path, content] : files_read())
    if (texts.count(path) == 0) {
      facts.push_back(digest_fact(fmt::format("file {}", short_name(path, folder).string()), content));
      facts.back().may_be_new = may_be_new, facts.back().scope = Fact::Scope::file;
    }
}

/// Returns the facts that the other list does not have, in their order.
std::vector<const Fact*> unmatched(const std::vector<Fact>& facts, const std::vector<Fact>& others) {
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> counts;
  for (const Fact& other : others) ++counts[{other.name, other.text}];
  std::vector<const Fact*> left;
  for (const Fact& fact : facts)
    if (std::size_t& count = counts[{fact.name, fact.text}]; count > 0)
      --count;
    else
      left.push_back(&fact);
  return left;
}

}  // namespace

std::string digest_of(const Job& job) {
  std::string all(kVersion);
  for (const Fact& fact : facts_of(job, all_frames(job))) all += fmt::format("\n{}: {}", fact.name, fact.text);
  return fmt::format("{:016x}", digest(all));
}

FramesPart all_frames(const Job& job) {
  const FileFrames& frames = job.description->frames;
  return {frames.moments(), static_cast<int>(frames.combinations().size())};
}

std::vector<Fact> facts_of(const Job& job, const FramesPart& part) {
  std::vector<Fact> facts;
  add_settings(job, facts);
  for (Fact& fact : facts_of_scene(job, part)) facts.push_back(std::move(fact));
  return facts;
}

std::vector<Fact> facts_of_scene(const Job& job, const FramesPart& frames) {
  const PartOfScene part(*job.description, frames);
  const bool is_all = frames.count() == job.description->frames.count();
  std::vector<Fact> facts;
  const std::vector<ElementDigest> elements = digests_of(*job.description, frames);
  add_order(elements, part, facts);
  for (const ElementDigest& element : elements) {
    const bool may_be_new = !is_all && part.can_do_without(element);
    facts.push_back(digest_fact(element.name, element.digest, element.where));
    facts.back().may_be_new = may_be_new;
    if (element.kind == ElementDigest::Kind::variation) {
      const auto& axis = job.description->axes[static_cast<std::size_t>(element.axis)];
      facts.back().scope = Fact::Scope::variation;
      facts.back().of = axis.variations[static_cast<std::size_t>(element.variation)].name;
    }
  }
  add_presence(*job.description, part, elements, frames, facts);
  add_files(*job.description, !is_all, facts);
  return facts;
}

std::string Difference::in_words(const Since& since) const {
  if (then == nullptr) return fmt::format("{} is new since {}", now->name, since.what);
  if (now == nullptr) return fmt::format("{} has been removed since {}", then->name, since.what);
  if (now->is_digest) return fmt::format("{} has changed since {}", now->name, since.what);
  return fmt::format("{}: {} now, {} in {}", now->name, now->text, then->text, since.what);
}

std::vector<Difference> differences(const std::vector<Fact>& then, const std::vector<Fact>& now) {
  std::map<std::string_view, std::deque<const Fact*>> before;  // by name
  for (const Fact* fact : unmatched(then, now)) before[fact->name].push_back(fact);
  std::vector<Difference> all;
  for (const Fact* fact : unmatched(now, then)) {
    std::deque<const Fact*>& same = before[fact->name];
    if (!same.empty()) {
      all.push_back({same.front(), fact});
      same.pop_front();
    } else if (!fact->may_be_new) {
      all.push_back({nullptr, fact});
    }
  }
  for (const auto& [name, left] : before)
    for (const Fact* fact : left) all.push_back({fact, nullptr});
  return all;
}

void compare(const std::vector<Fact>& then, const std::vector<Fact>& now, Diagnostics& diagnostics,
             const Since& since) {
  for (const Difference& each : differences(then, now))
    diagnostics.error(each.where(), each.in_words(since), since.way_out);
}

// One by one: a large count without contents must not allocate.
void persist(std::vector<Fact>& facts, StateStream& state) {
  std::uint64_t count = facts.size();
  state.value(count);
  if (count > kMostFacts) throw std::runtime_error("it has too many entries");
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i == facts.size()) facts.emplace_back();
    state.text(facts[i].name, kMostText);
    state.text(facts[i].text, kMostText);
    std::uint8_t digest = facts[i].is_digest;
    state.value(digest);
    facts[i].is_digest = digest != 0;
    state.value(facts[i].scope);
    if (facts[i].scope > Fact::Scope::file) throw std::runtime_error("it is damaged");
    state.text(facts[i].of, kMostText);
  }
}

}  // namespace dspm
