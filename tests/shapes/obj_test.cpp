// OBJ and MTL files: indices of all forms, groups, materials; and meshes in the scene's text.
#include "dspm/shapes/obj.h"

#include <gtest/gtest.h>

#include "tests/shapes/making.h"
#include "tests/support/temporary_directory.h"

namespace dspm {
namespace {

using Texts = std::vector<std::string>;

class Obj : public testing::Test {
 protected:
  ObjFile read(const std::string& text, const std::string& group = "", bool split = true) {
    test::put_file(directory / "mesh.obj", text);
    return read_obj(directory / "mesh.obj", group, split);
  }
  std::vector<MadeShape> make(std::vector<Param> params) {
    params.push_back(test::param(ParamType::text, "filename", Texts{(directory / "mesh.obj").string()}));
    return test::make_shapes("objmesh", {params}, diagnostics);
  }

  test::TemporaryDirectory directory;
  Diagnostics diagnostics;
};

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(Obj, AllFormsOfIndices) {
  const std::string more = kSquare + "vt 0 0\nvt 1 0.5\nvn 0 0 1\nvn 0 0 -1\n";
  const auto mesh = [&](const std::string& face) { return read(more + face).meshes.at(0).mesh; };
  EXPECT_EQ(mesh("f 1 2 3").vertices[2], (Vec3{1, 1, 0}));
  EXPECT_EQ(mesh("f -4 -3 -1").vertices[2], (Vec3{0, 1, 0}));
  EXPECT_TRUE(mesh("f 1 2 3").normals.empty());
  EXPECT_TRUE(mesh("f 1 2 3").uvs.empty());
  EXPECT_EQ(mesh("f 1/2 2/1 3/-1").uvs[0], (Vec2{1, 0.5f}));
  EXPECT_EQ(mesh("f 1//2 2//1 3//2").normals[0], (Vec3{0, 0, -1}));
  const MeshData full = mesh("f 1/1/1 2/2/1 3/1/1 4/2/1");
  EXPECT_EQ(full.faces, (std::vector<Face>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(full.uvs[1], (Vec2{1, 0.5f}));
  EXPECT_EQ(full.normals[3], (Vec3{0, 0, 1}));
  // A vertex that has two texture coordinates is two vertices, one that has the same twice is one.
  EXPECT_EQ(mesh("f 1/1 2/1 3/1\nf 1/2 3/1 4/1").vertices.size(), 5u);
}

TEST_F(Obj, VerticesMayFollowFaces) {
  EXPECT_EQ(read("f 1 2 3\n" + kSquare).meshes.at(0).mesh.vertices[1], (Vec3{1, 0, 0}));
}

TEST_F(Obj, BadIndicesAreErrors) {
  EXPECT_THROW(read(kSquare + "f 1 2 5"), std::runtime_error);
  EXPECT_THROW(read(kSquare + "f 1 2 0"), std::runtime_error);
  EXPECT_THROW(read(kSquare + "f 1 2 -5"), std::runtime_error);
  EXPECT_THROW(read(kSquare + "f 1/1 2/1 3/1"), std::runtime_error);
  EXPECT_THROW(read(kSquare + "f 1//1 2//1 3//1"), std::runtime_error);
  EXPECT_THROW(read(kSquare + "f 1 x 3"), std::runtime_error);
}

TEST_F(Obj, GroupsAndObjectsCanBeChosen) {
  const std::string text = kSquare + "o chair\ng seat soft\nf 1 2 3 4\ng leg\nf 1 2 3\no table\nf 2 3 4\nf 1 3 4\n";
  EXPECT_EQ(read(text).meshes.at(0).mesh.faces.size(), 5u);
  EXPECT_EQ(read(text, "seat").meshes.at(0).mesh.faces.size(), 2u);
  EXPECT_EQ(read(text, "soft").meshes.at(0).mesh.faces.size(), 2u);
  EXPECT_EQ(read(text, "chair").meshes.at(0).mesh.faces.size(), 3u);
  EXPECT_EQ(read(text, "table").meshes.at(0).mesh.faces.size(), 2u);
  EXPECT_EQ(read(text).groups, (Texts{"chair", "seat", "soft", "leg", "table"}));
  EXPECT_TRUE(make({test::param(ParamType::text, "group", Texts{"legs"})}).empty());
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_NE(diagnostics.all()[0].hint.find("\"leg\""), std::string::npos);
}

TEST_F(Obj, MaterialsBecomeParts) {
  test::put_file(directory / "lib.mtl",
                 "newmtl red\nKd 0.8 0.1 0.2\nnewmtl wood \nKd 1 1 1\nmap_Kd -s 1 1 1 wood.png\nmap_d wood.png\n"
                 "newmtl lost\nKd 0.5 0.5 0.5\nmap_Kd lost.png\n");
  test::put_file(directory / "wood.png", "");
  read("mtllib lib.mtl\n" + kSquare +
       "f 1 2 3\nusemtl red\nf 1 3 4\nusemtl wood\nf 1 2 4\nusemtl red\nf 2 3 4\nusemtl none\nf 1 2 3\nusemtl lost\nf "
       "1 2 3\n");
  const auto made = make({});
  ASSERT_EQ(made.size(), 5u);
  EXPECT_FALSE(made[0].material);
  ASSERT_TRUE(made[1].material);
  EXPECT_EQ(made[1].material->name, "red");
  EXPECT_EQ(made[1].shape->primitive_count(), 2);
  EXPECT_EQ(made[1].material->type, "diffuse");
  EXPECT_EQ(std::get<std::vector<float>>(made[1].material->params.find("reflectance")->values),
            (std::vector<float>{0.8f, 0.1f, 0.2f}));
  ASSERT_TRUE(made[2].material);
  ASSERT_EQ(made[2].material->textures.size(), 1u);
  EXPECT_EQ(made[2].material->textures[0].file, directory / "wood.png");
  EXPECT_EQ(made[2].material->alpha, directory / "wood.png");
  EXPECT_EQ(made[2].material->type, "principled");  // it has an alpha
  EXPECT_EQ(std::get<Texts>(made[2].material->params.find("basecolor")->values),
            Texts{made[2].material->textures[0].name});
  EXPECT_FALSE(made[3].material);  // "none"
  EXPECT_TRUE(made[4].material->textures.empty());
  EXPECT_NE(test::messages(diagnostics).find("\"none\" is not defined"), std::string::npos);
  EXPECT_NE(test::messages(diagnostics).find("lost.png"), std::string::npos);
  EXPECT_EQ(diagnostics.error_count(), 0);

  const auto whole = make({test::param(ParamType::boolean, "materials", std::vector<bool>{false})});
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_EQ(whole[0].shape->primitive_count(), 6);
  EXPECT_FALSE(whole[0].material);
}

TEST_F(Obj, ALineWithANumberThatIsNoneIsNamed) {
  const auto error = [&](const std::string& line) -> std::string {
    try {
      read(kSquare + line + "\nf 1 2 3\n");
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "none";
  };
  EXPECT_EQ(error("v 1 1 x"), "line 5: v 1 1 x: \"x\" is not a number");
  EXPECT_EQ(error("v 1 1"), "line 5: v 1 1: 2 of 3 numbers");
  EXPECT_EQ(error("v 1 1 nan"), "line 5: v 1 1 nan: \"nan\" is not a number");
  EXPECT_EQ(error("vn 1 1 1,0"), "line 5: vn 1 1 1,0: \"1,0\" is not a number");
  EXPECT_EQ(error("vt"), "line 5: vt: 0 of 1 numbers");
  EXPECT_EQ(error("v 1 \\\n1 x"), "line 5: v 1  1 x: \"x\" is not a number");
  EXPECT_EQ(error("v 1 1 1e99"), "line 5: v 1 1 1e99: \"1e99\" is not a number");
  EXPECT_EQ(error("f 1 2 3.5"), "line 5: f 1 2 3.5: \"3.5\" is not a vertex of a face");
  EXPECT_EQ(error("f 1 2 /3"), "line 5: f 1 2 /3: \"/3\" is not a vertex of a face");
  for (const char* fine : {"v +1 1e-3 .5 # 1", "v 1 1 1 0.5 0.5 0.5", "v 1 1 1e-50", "vt 1", "vp x", "f 1 2 3\r"})
    EXPECT_EQ(error(fine), "none") << fine;
}

// What programs write before and after the statements, and between them.
TEST_F(Obj, IsReadAsProgramsWriteIt) {
  const MeshData plain = read(kSquare + "f 1 2 3 4\n").meshes.at(0).mesh;
  const auto with_ends = [](std::string text, const std::string& end) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += end.size()) text.replace(at, 1, end);
    return text;
  };
  for (const std::string& text :
       {"\xEF\xBB\xBF" + kSquare + "f 1 2 3 4\n", with_ends("# none\n" + kSquare + "f 1 2 3 4\n", "\r"),
        with_ends(kSquare + "f 1 2 3 4\n", "\r\n"), kSquare + "f 1 2 \\\n 3 4\n", kSquare + "f 1 2 \\\r\n3 \\\r\n4\n",
        kSquare + "f 1 2 3 4 # front\n", kSquare + "f 1 2 3 4# 5\n", kSquare + "\tf\t1 2\t3 4 \n",
        kSquare + "fo 1/ 2// 3 4\n", kSquare + "f 1 2 3 4\nv 5 5 5 # \\\nv 1 1 1\n"}) {
    const MeshData mesh = read(text).meshes.at(0).mesh;
    EXPECT_EQ(mesh.vertices, plain.vertices) << text;
    EXPECT_EQ(mesh.faces, plain.faces) << text;
  }
}

TEST_F(Obj, MaterialFilesHaveNamesOfAllKinds) {
  for (const char* name : {"my paints.mtl", "plain.mtl", "other.mtl"})
    test::put_file(directory / name, "newmtl " + std::string(name) + " paint\nKd 1 0 0\n");
  std::filesystem::create_directory(directory / "lib");
  test::put_file(directory / "lib/far.mtl", "newmtl far.mtl paint\nKd 1 0 0\n");
  const auto materials = [&](const std::string& names) {
    Texts all;
    for (const FileMaterial& m : read("mtllib " + names + "\n" + kSquare).materials) all.push_back(m.name);
    return all;
  };
  EXPECT_EQ(materials("my paints.mtl"), Texts{"my paints.mtl paint"});
  EXPECT_EQ(materials("\"my paints.mtl\""), Texts{"my paints.mtl paint"});
  EXPECT_EQ(materials("plain.mtl my paints.mtl other.mtl"),
            (Texts{"plain.mtl paint", "my paints.mtl paint", "other.mtl paint"}));
  EXPECT_EQ(materials("lib\\far.mtl"), Texts{"far.mtl paint"});
  EXPECT_EQ(materials("C:\\work\\plain.mtl"), Texts{"plain.mtl paint"});
  EXPECT_EQ(materials("plain.mtl # of the wall"), Texts{"plain.mtl paint"});
  EXPECT_EQ(materials("plain.mtl\nmtllib plain.mtl"), Texts{"plain.mtl paint"});
  EXPECT_EQ(read("mtllib no paints.mtl plain.mtl\n" + kSquare).complaints,
            Texts{"there is no material file \"no paints.mtl\""});
}

// sRGB, as MeshLab and Blender write them; ZBrush's are bytes.
TEST_F(Obj, VerticesHaveColours) {
  for (const char* colour : {" 1 0.7353570 0", " 255 187.516 0"}) {
    const std::string text = "v 0 0 0" + std::string(colour) + "\nv 1 0 0\nv 0 1 0 1\nf 1 2 3\n";
    const auto colours = read(text).meshes.at(0).mesh.colours;
    ASSERT_EQ(colours.size(), 3u);
    EXPECT_EQ(colours[0][0], 1);
    EXPECT_NEAR(colours[0][1], 0.5f, 1e-4f);
    EXPECT_EQ(colours[0][2], 0);
    EXPECT_EQ(colours[1], (std::array<float, 4>{1, 1, 1, 1}));
  }
  EXPECT_TRUE(read(kSquare + "f 1 2 3\n").meshes.at(0).mesh.colours.empty());
}

TEST_F(Obj, ANameMayHaveANumberSign) {
  test::put_file(directory / "a.mtl", "newmtl Material #25\nKd 1 0 0\nnewmtl red\nKd 1 0 0\n");
  const ObjFile file = read("mtllib a.mtl\n" + kSquare + "usemtl Material #25\nf 1 2 3\nusemtl red # front\nf 1 3 4\n");
  EXPECT_EQ(file.meshes.at(0).material, "Material #25");
  EXPECT_EQ(file.meshes.at(1).material, "red");
}

/// The first material of an MTL file.
class Mtl : public Obj {
 protected:
  FileMaterial material(const std::string& statements, const std::string& head = "") {
    test::put_file(directory / "lib.mtl", head + "newmtl it\n" + statements);
    read("mtllib lib.mtl\nusemtl it\n" + kSquare + "f 1 2 3\n");
    return make({}).at(0).material.value();
  }
  static float number(const FileMaterial& material, const std::string& name) {
    return std::get<std::vector<float>>(material.params.find(name)->values).at(0);
  }
};

TEST_F(Mtl, OfBlenderHasBlendersMeanings) {
  const auto by_blender = [&](const std::string& statements) {
    return material("Ks .5 .5 .5\nNi 1.45\n" + statements,
                    "# Blender 3.4.1 MTL File: 'a.blend'\n# www.blender.org\n\n");
  };
  const FileMaterial faded = by_blender("Ns 250\nKa 1 1 1\nKd .8 .1 .1\nd 0.5\nillum 9\n");
  EXPECT_EQ(faded.type, "principled");
  EXPECT_EQ(number(faded, "alpha"), 0.5f);
  EXPECT_EQ(number(faded, "basecolor"), 0.8f);
  EXPECT_FLOAT_EQ(number(faded, "roughness"), 0.5f);
  EXPECT_EQ(number(faded, "metallic"), 0);
  EXPECT_EQ(number(faded, "specular"), 1);
  EXPECT_EQ(number(by_blender("Ns 1000\nKd 1 1 1\nillum 2\n"), "roughness"), 0);
  const FileMaterial metal = by_blender("Ns 360\nKa .75 .75 .75\nKd .9 .6 .3\nillum 3\n");
  EXPECT_EQ(number(metal, "metallic"), 0.75f);
  EXPECT_EQ(number(metal, "basecolor"), 0.9f);
  EXPECT_FLOAT_EQ(number(metal, "roughness"), 0.4f);
  const FileMaterial glass = by_blender("Ns 1000\nKd 1 1 1\nTf 1 1 1\nPr 0\nillum 2\n");
  EXPECT_EQ(number(glass, "transmission"), 1);
  EXPECT_EQ(number(glass, "eta"), 1.45f);
}

TEST_F(Mtl, IlluminationModelsOfGlassAreDielectric) {
  for (const char* illum : {"4", "6", "7", "9"}) {
    const FileMaterial glass = material("Kd 1 1 1\nNi 1.33\nd 0.1\nillum " + std::string(illum));
    EXPECT_EQ(glass.type, "dielectric") << illum;
    EXPECT_EQ(number(glass, "eta"), 1.33f);
    EXPECT_EQ(glass.params.find("roughness"), nullptr);
  }
  EXPECT_EQ(number(material("illum 4\n"), "eta"), 1.5f);
  EXPECT_EQ(number(material("illum 4\nPr 0.5\n"), "roughness"), 0.25f);
  EXPECT_EQ(material("illum 2\nNi 1.33\n").type, "diffuse");
  const FileMaterial amber = material("illum 6\nTf .9 .6 .2\nPr 0.3\n");
  EXPECT_EQ(amber.type, "principled");
  EXPECT_EQ(number(amber, "transmission"), 1);
  EXPECT_EQ(number(amber, "basecolor"), 0.9f);
  EXPECT_EQ(number(amber, "roughness"), 0.3f);
  EXPECT_EQ(test::messages(diagnostics), "");
}

TEST_F(Mtl, PhysicallyBasedStatementsArePrincipled) {
  const FileMaterial paint = material("Kd .1 .2 .3\nPr .4\nPm .5\nPs .6\nPc .7\nPcr .8\naniso .9\nNi 1.4\nKs 1 1 1\n");
  EXPECT_EQ(paint.type, "principled");
  EXPECT_EQ(number(paint, "basecolor"), 0.1f);
  const std::pair<const char*, float> expected[] = {{"roughness", 0.4f}, {"metallic", 0.5f},      {"sheen", 0.6f},
                                                    {"coat", 0.7f},      {"coatroughness", 0.8f}, {"anisotropy", 0.9f},
                                                    {"eta", 1.4f}};
  for (const auto& [name, value] : expected) EXPECT_EQ(number(paint, name), value) << name;
  EXPECT_EQ(paint.params.find("specular"), nullptr);
  EXPECT_EQ(number(material("Pm 7\n"), "metallic"), 1);  // out of range
  EXPECT_EQ(test::messages(diagnostics), "");
}

// alpha^2 = 2 / (Ns + 2); roughness is the root of alpha.
TEST_F(Mtl, KsAndNsAreAHighlight) {
  const FileMaterial plastic = material("Kd .1 .2 .3\nKs .25 .25 .25\nNs 30\nillum 2\n");
  EXPECT_EQ(plastic.type, "principled");
  EXPECT_NEAR(number(plastic, "roughness"), 0.5f, 1e-6f);
  EXPECT_NEAR(number(plastic, "specular"), 0.5f, 1e-6f);
  const FileMaterial gold = material("Kd 0 0 0\nKs .9 .7 .3\nNs 30\n");
  EXPECT_EQ(number(gold, "metallic"), 1);
  EXPECT_EQ(number(gold, "basecolor"), 0.9f);
  EXPECT_EQ(material("Kd .1 .2 .3\nKs 1 1 1\nillum 1\n").type, "diffuse");
}

TEST_F(Mtl, PicturesOfNumbersHoldNoColours) {
  test::put_file(directory / "r.png", "");
  const FileMaterial worn = material("map_Pr r.png\nmap_Kd r.png\nmap_Pm missing.png\n");
  EXPECT_EQ(worn.params.find("roughness")->type, ParamType::texture);
  ASSERT_EQ(worn.textures.size(), 2u);
  EXPECT_TRUE(worn.textures[0].is_spectrum);
  EXPECT_FALSE(worn.textures[1].is_spectrum);
  EXPECT_EQ(number(worn, "metallic"), 0);
  EXPECT_NE(test::messages(diagnostics).find("missing.png"), std::string::npos);
}

TEST_F(Mtl, KeIsEmission) {
  EXPECT_EQ(material("Ke 1 2 3\n").radiance, Rgb(1, 2, 3));
  EXPECT_EQ(material("Ke 1 2 3\n").type, "principled");
  EXPECT_EQ(material("Ke 1 2 3\nillum 4\n").type, "principled");
  EXPECT_FALSE(material("Ke 0 0 0\n").radiance);
  test::put_file(directory / "e.png", "");
  const FileMaterial lamp = material("Kd 0 0 0\nKe 5 5 5\nmap_Ke e.png\n");
  EXPECT_FALSE(lamp.radiance);
  EXPECT_EQ(lamp.params.find("emission")->type, ParamType::texture);
  EXPECT_EQ(number(lamp, "emissionstrength"), 5);
  EXPECT_EQ(test::messages(diagnostics), "");
}

TEST_F(Mtl, DissolveIsAlphaButOfGlass) {
  EXPECT_EQ(number(material("Kd 1 1 1\nd 0.25\n"), "alpha"), 0.25f);
  EXPECT_EQ(number(material("Kd 1 1 1\nTr 0.25\n"), "alpha"), 0.75f);
  EXPECT_EQ(material("Kd 1 1 1\nd 1\n").params.find("alpha"), nullptr);
  EXPECT_EQ(material("d 0.25\nillum 4\n").type, "dielectric");
  test::put_file(directory / "d.png", "");
  const FileMaterial leaf = material("Pr 0.5\nmap_d d.png\nmap_Kd d.png\nmap_Pr d.png\n");
  EXPECT_EQ(leaf.alpha, directory / "d.png");
  EXPECT_EQ(leaf.textures.size(), 2u);
}

TEST_F(Mtl, ColoursMayBeOneNumberOrInXyz) {
  const auto colour = [&](const std::string& statements) {
    return std::get<std::vector<float>>(material(statements).params.find("reflectance")->values);
  };
  EXPECT_EQ(colour("Kd .5\n"), (std::vector<float>{0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(colour("KD .5 .25 1 # grey\n"), (std::vector<float>{0.5f, 0.25f, 1}));
  EXPECT_EQ(colour("\tKd .5 \\\n .25 1\n"), (std::vector<float>{0.5f, 0.25f, 1}));
  const std::vector<float> white = colour("Kd xyz 0.9505 1 1.0888\n");  // D65
  for (const float c : white) EXPECT_NEAR(c, 1, 2e-3f);
  const FileMaterial lamp = material("Kd 0\nKe .5\n");
  EXPECT_EQ(lamp.radiance->r, 0.5f);
  EXPECT_EQ(lamp.radiance->b, 0.5f);
  EXPECT_EQ(test::messages(diagnostics), "");
  material("Kd spectral paint.rfl 1\nd -halo 0.5\n");
  EXPECT_EQ(test::messages(diagnostics),
            "-halo of d of material \"it\" is left out\nKd spectral of material \"it\" is left out\n");
}

TEST_F(Mtl, PicturesAreFoundWhereOtherMachinesHadThem) {
  std::filesystem::create_directory(directory / "maps");
  test::put_file(directory / "maps/old wood.png", "");
  test::put_file(directory / "wood.png", "");
  EXPECT_EQ(material("map_kd maps\\old wood.png\n").textures.at(0).file, directory / "maps/old wood.png");
  EXPECT_EQ(material("map_Kd C:\\pictures\\wood.png\n").textures.at(0).file, directory / "wood.png");
  EXPECT_EQ(material("map_Kd /home/a/wood.png\n").textures.at(0).file, directory / "wood.png");
}

TEST_F(Mtl, HighlightsMayBeColoured) {
  const FileMaterial satin = material("Kd .1 .2 .3\nKs .4 .2 .1\nNs 30\n");
  EXPECT_NEAR(number(satin, "specular"), 0.8f, 1e-6f);
  const auto colour = std::get<std::vector<float>>(satin.params.find("specularcolor")->values);
  EXPECT_NEAR(colour[1], 0.5f, 1e-6f);
  EXPECT_NEAR(colour[2], 0.25f, 1e-6f);
  test::put_file(directory / "s.png", "");
  const FileMaterial worn = material("Kd .1 .2 .3\nmap_Ks s.png\nNs 30\n");
  EXPECT_EQ(worn.params.find("specularcolor")->type, ParamType::texture);
  EXPECT_EQ(number(worn, "specular"), 1);
  EXPECT_EQ(test::messages(diagnostics), "");
}

TEST_F(Mtl, ReliefsAreNormalMapsOrHeights) {
  test::put_file(directory / "b.png", "");
  const FileMaterial bumpy = material("Kd 1 1 1\nbump -bm 0.02 b.png\n");
  EXPECT_EQ(bumpy.params.find("displacement")->type, ParamType::texture);
  EXPECT_FALSE(bumpy.textures.at(0).is_spectrum);
  EXPECT_EQ(number(bumpy, of_picture("scale", bumpy.textures.at(0).name)), 0.02f);
  const FileMaterial bent = material("Pr .3\nnorm b.png\nmap_Bump b.png\n");
  EXPECT_EQ(std::get<Texts>(bent.params.find("normaltexture")->values), Texts{bent.textures.at(0).name});
  EXPECT_EQ(bent.textures.at(0).file, directory / "b.png");
  EXPECT_EQ(bent.params.find("displacement"), nullptr);
  EXPECT_NE(material("disp b.png\n").params.find("displacement"), nullptr);
  EXPECT_EQ(test::messages(diagnostics), "");
}

TEST_F(Mtl, OptionsOfPicturesAreTheirParameters) {
  test::put_file(directory / "a.png", "");
  const FileMaterial m =
      material("map_Kd -s 2 3 1 -o .25 .5 -clamp on -mm 0 .5 a.png\nPr .2\nmap_Pr -imfchan g a.png\n");
  ASSERT_EQ(m.textures.size(), 2u);
  const auto of = [&](const char* name, std::size_t texture) { return of_picture(name, m.textures[texture].name); };
  EXPECT_EQ(number(m, of("uscale", 0)), 2);
  EXPECT_EQ(number(m, of("vscale", 0)), 3);
  EXPECT_EQ(number(m, of("udelta", 0)), 0.25f);
  EXPECT_EQ(number(m, of("vdelta", 0)), 0.5f);
  EXPECT_EQ(number(m, of("scale", 0)), 0.5f);
  EXPECT_EQ(std::get<Texts>(m.params.find(of("wrap", 0))->values), Texts{"clamp"});
  EXPECT_EQ(std::get<Texts>(m.params.find(of("channel", 1))->values), Texts{"green"});
  EXPECT_EQ(m.params.find(of("uscale", 1)), nullptr);
  const FileMaterial short_forms = material("map_Kd -o .25 -s 2 -t 0 a.png\n");
  ASSERT_EQ(short_forms.textures.size(), 1u);
  EXPECT_EQ(number(short_forms, of_picture("uscale", short_forms.textures[0].name)), 2);
  EXPECT_EQ(test::messages(diagnostics), "");
}

TEST_F(Mtl, WhatIsLeftOutIsToldOnceByName) {
  test::put_file(directory / "a.png", "");
  test::put_file(directory / "lib.mtl",
                 "newmtl a\nKs 1 1 1\nmap_Ns a.png\nmap_Pc a.png\nnewmtl b\nKs 1 1 1\nmap_Ns a.png\nrefl b.png\n"
                 "map_Kd -boost 2 -t 1 a.png\nmap_d -s 2 2 1 -t 1 a.png\n"
                 "newmtl c\nillum 7\nKd .5 .5 .5\nKs 1 1 1\nmap_Kd a.png\nmap_Ks a.png\nNi 1.5\n"
                 "newmtl d\nillum 7\nKd 1 1 1\nKs .5 .5 .5\nTf .5 1 1\nnewmtl e\nillum 7\nKd .5 0 0\n"
                 "newmtl f\nKd .5 0 0\nTf .5 .5 .5\n");
  read("mtllib lib.mtl\nusemtl a\n" + kSquare + "f 1 2 3\n");
  make({});
  EXPECT_EQ(test::messages(diagnostics),
            "-t of map_Kd of material \"b\" is left out\n-t of map_d of material \"b\" is left out\n"
            "Kd of material \"e\" is left out\nKs of material \"d\" is left out\nTf of material \"f\" is left out\n"
            "map_Kd of material \"c\" is left out\nmap_Ks of material \"c\" is left out\nmap_Ns of "
            "material \"a\" and of 1 more is left out\nmap_Pc of "
            "material \"a\" is left out\nrefl of material \"b\" is left out\n");
}

TEST_F(Obj, AMissingOrEmptyMaterialFileIsAWarning) {
  test::put_file(directory / "empty.mtl", "");
  for (const char* name : {"absent.mtl", "empty.mtl"}) {
    read("mtllib " + std::string(name) + "\nusemtl a\n" + kSquare + "f 1 2 3\n");
    EXPECT_EQ(make({}).size(), 1u);
  }
  EXPECT_EQ(diagnostics.error_count(), 0);
  EXPECT_NE(test::messages(diagnostics).find("absent.mtl"), std::string::npos);
}

// Whether that is an error is for the world to say: it may be one of a sequence.
TEST_F(Obj, NoFacesAreNoShape) {
  for (const std::string& text : {kSquare, std::string(), std::string("# nothing yet\n")}) {
    read(text);
    EXPECT_TRUE(make({}).empty());
  }
  EXPECT_EQ(test::messages(diagnostics), "");
}

TEST(TriangleMeshPlugin, ReadsItsParameters) {
  Diagnostics diagnostics;
  const Param points = test::param(ParamType::point3, "P", std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const auto make = [&](std::vector<int> indices, std::vector<Param> more) {
    more.push_back(points);
    more.push_back(test::param(ParamType::integer, "indices", indices));
    return test::make_shapes("trianglemesh", {more}, diagnostics);
  };
  const Param uv = test::param(ParamType::point2, "uv", std::vector<float>{0, 0, 1, 0, 0, 1, 1, 1});
  const auto made = make({0, 1, 2, 2, 1, 3}, {uv});
  ASSERT_EQ(test::messages(diagnostics), "");
  EXPECT_EQ(made.at(0).shape->primitive_count(), 2);
  EXPECT_EQ(made.at(0).shape->surface_point(1, {0, 1}).uv, (Vec2{1, 1}));

  EXPECT_TRUE(make({0, 1, 4}, {}).empty());
  EXPECT_TRUE(make({0, 1}, {}).empty());
  make({0, 1, 2}, {test::param(ParamType::vector3, "S", std::vector<float>(9))});
  make({0, 1, 2}, {test::param(ParamType::integer, "faceIndices", std::vector<int>{4, 5})});
  const std::string text = test::messages(diagnostics);
  EXPECT_NE(text.find("refers to vertex 4"), std::string::npos);
  EXPECT_NE(text.find("the number of indices, 2"), std::string::npos);
  EXPECT_NE(text.find("3 tangents for 4 vertices"), std::string::npos);
  EXPECT_NE(text.find("2 face indices for 1 faces"), std::string::npos);
}

}  // namespace
}  // namespace dspm
