// Directives that repeat one another but for numbers are read in runs. Whatever stands among them, the description, its
// digests and all messages are those of directives that are read one by one: an empty block after each ends every run.
#include "dspm/lang/shape_run.h"

#include <random>

#include "dspm/lang/canonical.h"
#include "tests/lang/parsing.h"

namespace dspm::test {
namespace {

const std::string kEmptyBlock = " AttributeBegin AttributeEnd";

std::vector<ShapeUse> directives(const std::vector<ShapeUse>& shapes) {
  std::vector<ShapeUse> all;
  for_each_directive(shapes, [&](const ShapeUse& use) { all.push_back(use); });
  EXPECT_EQ(count_directives(shapes), all.size());
  return all;
}

using Place = std::tuple<int, int, int>;
Place place(const SourceLocation& where) { return {where.line, where.column, where.length}; }

void expect_equal(const ShapeUse& a, const ShapeUse& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(place(a.where), place(b.where));
  EXPECT_EQ(place(a.type_where), place(b.type_where)) << a.where.line;
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.material.index, b.material.index);
  EXPECT_EQ(a.world_from_object, b.world_from_object);
  ASSERT_EQ(a.params.params.size(), b.params.params.size()) << a.where.line;
  for (std::size_t i = 0; i < a.params.params.size(); ++i) {
    const Param &p = a.params.params[i], &q = b.params.params[i];
    EXPECT_EQ(p.name, q.name);
    EXPECT_EQ(p.type, q.type);
    EXPECT_EQ(p.values, q.values) << a.where.line;
    EXPECT_EQ(p.space, q.space);
    EXPECT_EQ(place(p.where), place(q.where)) << p.name;
    EXPECT_EQ(place(p.values_where), place(q.values_where)) << p.name;
  }
}

/// Returns how many directives were in runs.
std::size_t expect_as_one_by_one(const std::vector<std::string>& lines, const std::string& name = "scene.pbrt",
                                 const Defines& defines = {}) {
  std::string in_runs, apart;
  for (const std::string& line : lines)
    in_runs += line + "\n", apart += line + (line.starts_with("Film") ? "" : kEmptyBlock) + "\n";
  const Parsed a = parse(in_runs, defines, name), b = parse(apart, defines, name);
  const std::vector<ShapeUse> all = directives(a.scene.shapes), others = directives(b.scene.shapes);
  EXPECT_EQ(all.size(), others.size()) << in_runs;
  for (std::size_t i = 0; i < std::min(all.size(), others.size()); ++i) expect_equal(all[i], others[i]);

  const auto &said = a.diagnostics.all(), &expected = b.diagnostics.all();
  EXPECT_EQ(said.size(), expected.size()) << a.messages() << "\nand\n" << b.messages();
  for (std::size_t i = 0; i < std::min(said.size(), expected.size()); ++i) {
    EXPECT_EQ(said[i].message, expected[i].message);
    EXPECT_EQ(place(said[i].where), place(expected[i].where)) << said[i].message;
  }
  const auto left = digests_of(a.scene, {}), right = digests_of(b.scene, {});
  EXPECT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
    EXPECT_EQ(left[i].digest, right[i].digest) << left[i].name;
  return all.size() - a.scene.shapes.size();
}

class Strands {
 public:
  explicit Strands(unsigned seed) : random_(seed) {}

  int upto(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  template <class... Choices>
  std::string one_of(const Choices&... choices) {
    const std::string all[] = {choices...};
    return all[upto(sizeof...(choices))];
  }
  std::string number() { return one_of("0.25", "-1", "+.5", "1e-3", "7", "-2.5E2", "0"); }
  std::string blank() { return one_of(" ", " ", " ", "  ", "\t", "\n   ", " # a word\n "); }
  std::string points(int count) {
    std::string list = "[";
    for (int i = 0; i < 3 * count; ++i) list += blank() + number();
    return list + one_of("", " ", "\n") + "]";
  }
  std::string strand() {
    return R"(Shape "curve" "string type" [ "cylinder" ] "point3 P" )" + points(upto(4) == 0 ? 7 : 4) +
           " \"float width0\" [ " + number() + " ] \"float width1\" " + number();
  }
  /// Something that a run must not take for one of its own.
  std::string odd() {
    return one_of(
        R"(Shape "curve" "string type" [ "flat" ] "point3 P" [0 0 0 1 1 1 2 2 2 3 3 3] "float width0" [ 1 ] "float width1" 1)",
        strand() + " \"float width\" 2", strand() + " \"integer degree\" 3 \"string basis\" \"bezier\"",
        strand() + " \"float alpha\" 0.5", strand() + " \"string name\" \"lock\"", strand() + " \"float width0@2\" 3",
        strand() + " 3", strand() + " ]", strand() + "x", strand() + " [1]", strand() + "\nword", strand() + " # Shape",
        "  " + strand(), "# between", "Material \"hair\"", "Translate 1 0 0", "Shape \"sphere\"", "ReverseOrientation",
        "Attribute \"shape\" \"float width1\" 2", "ColorSpace \"rec2020\"",
        R"(Shape "curve" "string type" [ "cylinder" ] "point3 P" [ 0 0 ] "float width0" [ 1 ] "float width1" 1)",
        R"(Shape "curve" "string type" [ "cylinder" ] "point3 P" [ 0 0 a ] "float width0" [ 1 ] "float width1" 1)",
        R"(Shape "curve" "string type" [ "cylinder" ] "point3 P" [ 0 0 inf ] "float width0" [ 1 ] "float width1" 1)",
        R"(Shape "curve" "string type" [ "cylinder" ] "point3 P" [ 0 0 1e-60 ] "float width0" [ 1 ] "float width1" 1)",
        R"(Shape "curve" "string type" [ "cylinder" ] "point3 P" [ ] "float width0" [ 1 2 ] "float width1" 1)",
        R"(Shape "curve" "string type" [ "cylinder" ] "point3 P" [ 0 0 0 ] "float width0" [ 1 ] "float width1" 1 2)");
  }

 private:
  std::mt19937 random_;
};

TEST(ShapeRun, IsWhatOneByOneGives) {
  std::size_t in_runs = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    Strands strands(seed);
    std::vector<std::string> lines{"WorldBegin"};
    for (int i = strands.upto(40); i >= 0; --i)
      lines.push_back(strands.upto(6) == 0 ? strands.odd() : strands.strand());
    in_runs += expect_as_one_by_one(lines);
    if (HasFailure()) FAIL() << "seed " << seed;
  }
  EXPECT_GT(in_runs, 1500u);
}

TEST(ShapeRun, IsReadFromOldScenesAndThroughDefines) {
  const std::string old = R"(Shape "curve" "string type" "cylinder" "point P" [0 0 0 1 0 0 2 0 0 3 0 )";
  const std::vector<std::string> scene{"Film \"image\"", "WorldBegin", old + "1] \"float width\" .5",
                                       old + "2] \"float width\" 2", old + "3] \"float width\" 3"};
  EXPECT_EQ(expect_as_one_by_one(scene), 2u);
  const std::string defined = R"(Shape "curve" "point3 P" [0 0 0 1 0 0 2 0 0 3 0 )";
  EXPECT_EQ(expect_as_one_by_one({"WorldBegin", defined + "$x]", defined + "5]", defined + "$x]"}, "scene.dsc",
                                 {{"x", "17.5"}}),
            2u);
}

TEST(ShapeRun, KnowsThePlacesInTheText) {
  const SceneDescription scene = good(R"(WorldBegin
Shape "curve" "point3 P" [1 2 3]
  Shape "curve" "point3 P" [
 40 5 6] # a strand
Shape "curve" "point3 P" [])");
  ASSERT_EQ(scene.shapes.size(), 1u);
  ASSERT_EQ(scene.shapes[0].run->count(), 2u);
  const ShapeUse strand = scene.shapes[0].run->at(0, scene.shapes[0]);
  EXPECT_EQ(floats(strand.params, "P"), (std::vector<float>{40, 5, 6}));
  EXPECT_EQ(place(strand.where), Place(3, 3, 5));
  EXPECT_EQ(place(strand.params.params[0].where), Place(3, 17, 10));
  EXPECT_EQ(place(strand.params.params[0].values_where), Place(4, 2, 2));
}

}  // namespace
}  // namespace dspm::test
