// The copy of a plain scene for a machine points into that machine's memory only, and light takes the same ways in it.
#include "dspm/integrators/waves/plain_copy.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <set>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "dspm/image/png.h"
#include "dspm/integrators/photons/trace_photons.h"
#include "dspm/integrators/waves/plain_objects.h"
#include "dspm/integrators/waves/threads_machine.h"
#include "dspm/integrators/waves/wave_photons.h"
#include "dspm/integrators/waves/wave_tracer_on.h"
#include "dspm/testing/test_scene.h"
#include "tests/integrators/digits.h"
#include "tests/integrators/plain_random_scene.h"
#include "tests/support/temporary_directory.h"

namespace dspm::test {
namespace plain_copy_test {

/// The memory of a machine that does not exist: a range of addresses of our own.
class Arena {
 public:
  Arena() {
    void* const memory =
        mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    begin_ = static_cast<std::byte*>(memory);
  }
  ~Arena() { munmap(begin_, kSize); }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  void* allocate(std::size_t bytes) {
    if (bytes > kSize - used_) throw std::bad_alloc();
    ++pieces_;
    return begin_ + std::exchange(used_, (used_ + bytes + 255) / 256 * 256);
  }
  void free(void*) { --pieces_; }
  void copy_in(void* to, const void* from, std::size_t bytes) {
    EXPECT_TRUE(holds(reinterpret_cast<std::uintptr_t>(to), bytes));
    std::memcpy(to, from, bytes);
    copied_ += bytes;
  }

  bool holds(std::uintptr_t address, std::size_t bytes) const {
    const auto begin = reinterpret_cast<std::uintptr_t>(begin_);
    return begin <= address && address - begin + bytes <= used_;
  }
  int pieces() const { return pieces_; }
  std::size_t copied() const { return copied_; }

 private:
  static constexpr std::size_t kSize = std::size_t{1} << 28;

  std::byte* begin_;
  std::size_t used_ = 0, copied_ = 0;
  int pieces_ = 0;
};

/// The addresses that this process can read.
class Mappings {
 public:
  Mappings() {
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
      unsigned long long begin, end;
      char readable;
      if (std::sscanf(line.c_str(), "%llx-%llx %c", &begin, &end, &readable) != 3 || readable != 'r') continue;
      constexpr unsigned long long kShadow = 1ull << 36;  // as large as this, they are sanitizers' own
      if (end - begin < kShadow) ranges_.push_back({begin, end});
    }
  }
  bool contain(std::uint64_t address) const {
    if (address >> 32 == 0) return false;  // a small number
    return std::ranges::any_of(ranges_, [&](const Range& r) { return r.begin <= address && address < r.end; });
  }

 private:
  struct Range {
    std::uint64_t begin, end;
  };
  std::vector<Range> ranges_;
};

/// Walks over all that a plain scene points to.
class Survey {
 public:
  Survey(PlainScene scene, const Arena& arena) : arena_(arena) {
    look_at(scene);
    visit_arrays(scene);
  }

#if __has_builtin(__builtin_clear_padding)
  static constexpr bool kKnowsGaps = true;
#else
  static constexpr bool kKnowsGaps = false;  // then addresses() is 0
#endif

  /// The number of arrays outside of the arena.
  std::size_t outside() const { return outside_; }
  /// The number of words that may be addresses elsewhere, whether an each_array() tells of them or not.
  std::size_t addresses() const { return addresses_; }
  const std::set<std::type_index>& types() const { return types_; }

 private:
  template <class T>
  void visit_arrays(T& value) {
    value.each_array([this](auto& array, std::size_t count) {
      if (array != nullptr && count > 0) this->visit(array, count);
    });
  }

  template <class T>
  void visit(const T* array, std::size_t count) {
    types_.insert(typeid(T));
    if (!arena_.holds(reinterpret_cast<std::uintptr_t>(array), count * sizeof(T))) ++outside_;
    if (!seen_.insert({array, typeid(T)}).second) return;
    for (std::size_t i = 0; i < count; ++i) {
      T element = array[i];
      if constexpr (HasArrays<T>) visit_arrays(element);
      look_at(element);
    }
  }

  /// Nobody writes to the rest of a packet that is not full, nor to bytes of a union beyond those of its kind, nor to
  /// gaps between members.
  template <class T>
  void look_at(T& value) {
    if constexpr (std::is_same_v<T, TrianglePacket>) return;
    if constexpr (requires { value.of_kind(IgnoreKind()); }) {
      value.of_kind([this](auto& kind) { this->look_at(kind); });
    } else if constexpr (std::is_same_v<T, PlainTree::Crowd>) {
      look_at(value.placed);
    } else {
      if constexpr (requires { value.shape.of_kind(IgnoreKind()); }) {
        look_at(value.shape);
        std::memset(static_cast<void*>(&value.shape), 0, sizeof value.shape);
      }
#if __has_builtin(__builtin_clear_padding)
      __builtin_clear_padding(&value);
      look_at_words(&value, sizeof(T));
#endif
    }
  }
  struct IgnoreKind {
    void operator()(auto&) const {}
  };

  void look_at_words(const void* bytes, std::size_t size) {
    for (std::size_t at = 0; at + sizeof(std::uint64_t) <= size; at += sizeof(std::uint64_t)) {
      std::uint64_t word;
      std::memcpy(&word, static_cast<const std::byte*>(bytes) + at, sizeof word);
      if (mappings_.contain(word) && !arena_.holds(word, 1)) ++addresses_;
    }
  }

  const Arena& arena_;
  Mappings mappings_;
  std::set<std::pair<const void*, std::type_index>> seen_;
  std::set<std::type_index> types_;
  std::size_t outside_ = 0, addresses_ = 0;
};

/// Textures within textures, pictures with and without holes, all kinds of rough surfaces, meshes with all that they may
/// have, each placed several times.
class Showroom {
 public:
  Showroom() {
    Image image(8, 4);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      image.pixels[i] = Rgb(0.1f + 0.02f * static_cast<float>(i), 0.5f, 0.3f);
      image.alpha.push_back(0.05f + 0.01f * static_cast<float>(i));
    }
    write_png(directory_ / "leaf.png", image);
    put_file(directory_ / "signed.ply", SceneFiles::signed_tangents());
  }

  std::string text() const {
    const std::string leaf = fmt::format("\"imagemap\" \"string filename\" \"{}\"", (directory_ / "leaf.png").string());
    std::string s = PlainRandomScene(3).text("\"dsppm\"") + "Texture \"leaf\" \"spectrum\" " + leaf +
                    "\nTexture \"holes\" \"float\" " + leaf + R"(
Texture "peel" "float" "wrinkled"
Texture "faded" "spectrum" "scale" "texture tex" "leaf" "texture scale" "peel"
Texture "dotted" "spectrum" "dots" "texture inside" "faded" "rgb outside" [.2 .3 .4]
Texture "board" "spectrum" "checkerboard" "texture tex1" "dotted" "texture tex2" "leaf"
Texture "worn" "spectrum" "mix" "texture tex1" "board" "texture tex2" "faded" "texture amount" "holes"
MakeNamedMaterial "varnish" "string type" "coateddiffuse" "texture reflectance" "worn" "float uroughness" .3 "float vroughness" .1
MakeNamedMaterial "brass" "string type" "coatedconductor" "texture conductor.roughness" "holes"
ObjectBegin "bush"
)";
    for (const char* material :
         {R"("diffuse" "texture reflectance" "worn")",
          R"("conductor" "texture reflectance" "board" "texture roughness" "holes")",
          R"("conductor" "texture eta" "leaf" "texture k" "worn" "float uroughness" .4 "texture vroughness" "peel")",
          R"("dielectric" "string glass" "SF11" "integer priority" 1)",
          R"("dielectric" "string glass" "water" "rgb attenuationcolor" [.9 .5 .2])",
          R"("dielectric" "float roughness" .2)", R"("dielectric" "texture roughness" "holes")",
          R"("dielectric" "float uroughness" .3 "float vroughness" .1)", R"("thindielectric" "texture tint" "faded")",
          R"("diffusetransmission" "texture reflectance" "leaf" "texture transmittance" "faded")",
          R"("coateddiffuse" "texture reflectance" "board" "texture roughness" "peel" "bool energycompensation" false)",
          R"("coatedconductor" "texture reflectance" "leaf" "texture interface.roughness" "peel")",
          R"("mix" "string materials" ["varnish" "brass"] "texture amount" "holes")"})
      s += fmt::format("Material {}\nTranslate .05 .1 .05\n{}", material,
                       R"(Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point2 uv" [0 0 1 0 1 1 0 1]
  "point3 P" [-.5 -.5 0  .5 -.5 0  .5 .5 .1  -.5 .5 0] "normal3 N" [0 .3 1  .2 0 1  0 -.2 1  -.1 0 1]
  "vector3 S" [1 0 0  1 .1 0  1 0 .1  1 .2 0]
Shape "sphere" "float radius" .2
Shape "bilinearmesh" "texture alpha" "holes" "point3 P" [-.3 -.3 0  .3 -.2 .1  -.3 .3 .1  .3 .3 0] "point2 uv" [0 0 1 0 0 2 1 1]
  "normal3 N" [0 .3 1  .2 0 1  0 -.2 1  -.1 0 1]
)");
    s += fmt::format("Shape \"plymesh\" \"string filename\" \"{}\"\nObjectEnd\n", (directory_ / "signed.ply").string());
    for (const char* place : {"-1 0 0", "0 -.6 .5", ".8 -.5 0"})
      s += fmt::format(
          "AttributeBegin Translate {} Rotate 30 0 1 1 Scale .4 .5 .6 ObjectInstance \"bush\" AttributeEnd\n", place);
    return s;
  }

 private:
  TemporaryDirectory directory_;
};

/// The first is the showroom.
std::string text_of(unsigned scene) {
  static const Showroom showroom;
  return scene == 0 ? showroom.text() : PlainRandomScene(scene).text("\"dsppm\"");
}

TEST(PlainCopy, PointsIntoItsMemoryOnly) {
  std::set<std::type_index> types;
  int of_frames = 0;
  for (unsigned seed = 0; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    TestScene test(text_of(seed));
    const auto scene = test.scene(test.all_frames());
    ASSERT_EQ(why_not_plain(*scene), "");
    const PlainObjects plain(*scene);
    Arena arena;
    {
      const PlainCopy copy(plain.scene(), arena);
      const Survey survey(copy.value(), arena), original(plain.scene(), arena);
      EXPECT_EQ(survey.outside(), 0u);
      EXPECT_EQ(survey.addresses(), 0u);
      EXPECT_EQ(survey.types(), original.types());
      EXPECT_GT(original.outside(), 10u);
      EXPECT_TRUE(original.addresses() > 10 || !Survey::kKnowsGaps);
      types.insert(survey.types().begin(), survey.types().end());
      of_frames += copy.value().query.of_frame != nullptr;
      EXPECT_GT(arena.pieces(), 0);
    }
    EXPECT_EQ(arena.pieces(), 0);
  }
  for (const std::type_index type : {std::type_index(typeid(PlainTree)),
                                     std::type_index(typeid(PlainTree::Placed)),
                                     std::type_index(typeid(Bvh::NodeFrames)),
                                     std::type_index(typeid(TrianglePacket)),
                                     std::type_index(typeid(FrameSet)),
                                     std::type_index(typeid(Face)),
                                     std::type_index(typeid(PatchCorners)),
                                     std::type_index(typeid(std::uint8_t)),
                                     std::type_index(typeid(Vec2)),
                                     std::type_index(typeid(Vec3)),
                                     std::type_index(typeid(AlbedoTable)),
                                     std::type_index(typeid(BrushedAlbedo)),
                                     std::type_index(typeid(BoundaryTables)),
                                     std::type_index(typeid(BrushedGlass)),
                                     std::type_index(typeid(PlainTexture<Rgb>)),
                                     std::type_index(typeid(PlainTexture<float>)),
                                     std::type_index(typeid(Rgb)),
                                     std::type_index(typeid(float)),
                                     std::type_index(typeid(PlainBody)),
                                     std::type_index(typeid(PlainIndex))})
    EXPECT_TRUE(types.contains(type)) << type.name();
  EXPECT_GT(of_frames, 0);
}

std::vector<std::string> in_words(const std::vector<PhotonTrace>& traces) {
  std::vector<std::string> photons;
  for (const PhotonTrace& trace : traces)
    for (const Photon& p : trace.photons)
      photons.push_back(
          fmt::format("{} {} {} {} {:x}", p.face.shape(), digits(p.p), digits(p.wi), digits(p.flux), p.frames.bits()));
  return photons;
}

TEST(PlainCopy, LeavesLightItsWays) {
  std::size_t all = 0;
  for (unsigned seed = 0; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    TestScene test(text_of(seed));
    const auto scene = test.scene(test.all_frames());
    PhotonSettings settings;
    settings.seed = seed, settings.max_depth = 6, settings.paths_per_trace = 512;
    ASSERT_EQ(why_not_in_waves(*scene, settings), "");
    const auto photons_in = [&](const PlainScene& plain) {
      WaveTracerOn<ThreadsMachine> tracer;
      tracer.load(plain);
      return in_words(trace_photons_in_waves(*scene, tracer, settings, 3, 100, 2100, {}));
    };
    const PlainObjects plain(*scene);
    Arena arena;
    const PlainCopy copy(plain.scene(), arena);
    const auto photons = photons_in(plain.scene());
    EXPECT_EQ(photons_in(copy.value()), photons);
    all += photons.size();
  }
  EXPECT_GT(all, 10'000u);
}

std::size_t bytes_copied(const std::string& text) {
  TestScene test(text);
  const auto scene = test.scene(test.all_frames());
  const PlainObjects plain(*scene);
  Arena arena;
  const PlainCopy copy(plain.scene(), arena);
  return arena.copied();
}

TEST(PlainCopy, HasOnceWhatIsPlacedOften) {
  const std::string bush = "Translate .1 0 0 ObjectInstance \"bush\"\n";
  const std::size_t few = bytes_copied(text_of(0)), more = bytes_copied(text_of(0) + bush + bush);
  EXPECT_GT(few, 100'000u);  // there are tables
  EXPECT_LT(more - few, 2 * 22 * (sizeof(PlainPlacedShape) + 8 * sizeof(PlainTree::Placed)));
}

}  // namespace plain_copy_test
}  // namespace dspm::test
