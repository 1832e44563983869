// Material files: the rules of read_mtl.h, and invalid files.
#include "meshprep/read/read_mtl.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::contains;
using test::errorMessage;

std::vector<std::string> notes;
std::vector<SourceImage> images;

SourceMaterial one(const std::string& statements) {
  notes.clear();
  images.clear();
  return parseMtl("newmtl m\n" + statements, "a.mtl", notes, images).at(0);
}
std::string errorIn(const std::string& text) {
  return errorMessage([&] {
    std::vector<std::string> ignored;
    parseMtl(text, "a.mtl", ignored, images, true);
  });
}

TEST(ReadMtl, ReadsDiffuseMaterials) {
  for (const char* text : {"Kd 0.25 0.5 0.75\n", "Kd 0.25 0.5 0.75\r\nKs 0 0 0\r\nNs 100\r\n",
                           "# comment\nKa 1 1 1\nKd 0.25 0.5 0.75\nKs 1 1 1\nillum 1\n"}) {
    const SourceMaterial m = one(text);
    EXPECT_EQ(m.name, "m");
    EXPECT_EQ(m.baseColour, glm::dvec3(0.25, 0.5, 0.75)) << text;
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.roughness, 1) << text;
    EXPECT_EQ(m.transmission, 0);
    EXPECT_TRUE(notes.empty());
  }
  EXPECT_EQ(one("Kd 0.5\n").baseColour, glm::dvec3(0.5));  // one number for all components
  EXPECT_EQ(one("Kd 2 -1 0.5\n").baseColour, glm::dvec3(1, 0, 0.5));
  EXPECT_EQ(one("").baseColour, glm::dvec3(0.8));
}

TEST(ReadMtl, ConvertsHighlightsToRoughness) {
  const SourceMaterial m = one("Kd 0.5 0.5 0.5\nKs 0.2 0.2 0.2\nNs 198\nNi 1.7\n");
  EXPECT_EQ(m.metallic, 0);
  EXPECT_NEAR(m.roughness * m.roughness, std::sqrt(2.0 / 200), 1e-15);  // alpha 0.1
  EXPECT_EQ(m.ior, 1.7);
  EXPECT_EQ(one("Ks 0.2 0.2 0.2\nNs -5\n").roughness, 1);
}

TEST(ReadMtl, RecognizesMetals) {
  const SourceMaterial m = one("Kd 0.05 0 0\nKs 0.9 0.6 0.3\nNs 1000\n");
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.baseColour, glm::dvec3(0.9, 0.6, 0.3));
  EXPECT_EQ(one("Kd 0.5 0 0\nKs 0.9 0.6 0.3\n").metallic, 0);
  EXPECT_EQ(one("Kd 0 0 0\nKs 0.5 0.5 0.5\n").metallic, 0);
  const SourceMaterial explicitMetal = one("Kd 0.9 0.6 0.3\nPm 1\nPr 0.25\n");
  EXPECT_EQ(explicitMetal.metallic, 1);
  EXPECT_EQ(explicitMetal.roughness, 0.25);
  EXPECT_EQ(explicitMetal.baseColour, glm::dvec3(0.9, 0.6, 0.3));
}

TEST(ReadMtl, ReadsTransmissionAndEmission) {
  EXPECT_EQ(one("d 0.25\n").transmission, 0.75);
  EXPECT_FALSE(one("d 0.25\n").isThinWalled);  // a body
  EXPECT_EQ(one("Kd 0 0 0\nKs 1 1 1\nd 0.25\n").metallic, 0);
  EXPECT_EQ(one("Kd 0 0 0\nKs 1 1 1\nd 0.75\n").metallic, 1);
  EXPECT_EQ(one("d -halo 0.25\n").transmission, 0.75);
  EXPECT_EQ(one("Tr 0.75\n").transmission, 0.75);
  EXPECT_EQ(one("Tf 0.5 0.75 1\nillum 6\n").transmission, 1);
  EXPECT_EQ(one("Tf 0.5 0.75 1\nillum 2\n").transmission, 0);
  const SourceMaterial tinted = one("Tf 0.5 0.75 1\nillum 6\nd 0\n");
  EXPECT_TRUE(tinted.hasVolume);
  EXPECT_EQ(tinted.attenuationColour, glm::dvec3(0.5, 0.75, 1));
  EXPECT_EQ(tinted.attenuationDistance, 1);
  EXPECT_EQ(one("Ke 3 2 1\n").emissive, glm::dvec3(3, 2, 1));
  EXPECT_EQ(one("Ni 0.5\n").ior, 1.5);
  EXPECT_CONTAINS(notes.at(0), "below 1");
}

TEST(ReadMtl, PrefersDToTr) {
  // Programs write Tr as 1 - d or with the meaning of d.
  EXPECT_EQ(one("d 1.0\nTr 0.0\n").transmission, 0);
  EXPECT_TRUE(notes.empty());
  EXPECT_NEAR(one("Tr 0.333\nd 0.6667\n").transmission, 0.3333, 1e-12);
  EXPECT_TRUE(notes.empty());
  for (const char* text : {"d 1\nTr 1\n", "Tr 1\nd 1\n"}) {
    EXPECT_EQ(one(text).transmission, 0) << text;
    ASSERT_EQ(notes.size(), 1u) << text;
    EXPECT_CONTAINS(notes[0], "contradicts", "\"m\"");
  }
  for (const char* text : {"d 0\nTr 0\n", "Tr 0 # opaque\nd 0\n"}) {
    EXPECT_EQ(one(text).transmission, 1) << text;
    EXPECT_CONTAINS(notes.at(0), "contradicts");
  }
  one("Tr 1\n");
  EXPECT_CONTAINS(notes.at(0), "without d");
  one("Tr 0\n");
  EXPECT_TRUE(notes.empty());
}

TEST(ReadMtl, AcceptsCommentsAndCrLineEnds) {
  std::vector<std::string> found;
  const auto materials =
      parseMtl("newmtl red # the first\rKd 0.5 # grey\rd 0.25#x\rillum 2 #\rnewmtl Material #25\rKe 1 2 3 # lamp\r\0",
               "a.mtl", found, images);
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_EQ(materials[0].name, "red");
  EXPECT_EQ(materials[0].baseColour, glm::dvec3(0.5));
  EXPECT_EQ(materials[0].transmission, 0.75);
  EXPECT_EQ(materials[1].name, "Material #25");
  EXPECT_EQ(materials[1].emissive, glm::dvec3(1, 2, 3));
  EXPECT_EQ(found, (std::vector<std::string>{"accepted: CR line ends", "accepted: comments at line ends"}));
}

TEST(ReadMtl, FindsFilesOfOtherSpellings) {
  const std::filesystem::path folder = test::temporaryPath("");
  std::filesystem::create_directories(folder / "sub");
  for (const char* name : {"sub/in.mtl", "a b.mtl", "c#1.mtl", "odd\\name.mtl"}) std::ofstream(folder / name) << "\n";
  const auto found = [&](const std::string& statement) {
    const auto files = listMaterialFiles(folder / "a.obj", {statement});
    return files.size() == 1 ? files[0].lexically_normal().lexically_relative(folder).string() : "several";
  };
  for (const char* statement : {"sub/in.mtl", "sub\\in.mtl", ".\\sub\\in.mtl", "sub\\\\in.mtl", "sub\\in.mtl # comment",
                                "sub\\in.mtl#comment", "\"sub\\in.mtl\"", "./sub\\..\\sub/in.mtl"})
    EXPECT_EQ(found(statement), "sub/in.mtl") << statement;
  EXPECT_EQ(found("a b.mtl"), "a b.mtl");
  EXPECT_EQ(found("a b.mtl #x"), "a b.mtl");
  EXPECT_EQ(found("c#1.mtl"), "c#1.mtl");
  EXPECT_EQ(found("odd\\name.mtl"), "odd\\name.mtl");
  EXPECT_EQ(found("sub\\none.mtl # x"), "sub/none.mtl");
  EXPECT_EQ(listMaterialFiles(folder / "a.obj", {"sub\\in.mtl c#1.mtl"}).size(), 2u);
  std::filesystem::remove_all(folder);
}

TEST(ReadMtl, CommentsBeginWithinKeywords) {
  EXPECT_EQ(one("d#1.0\nKd 0.25 0.5 0.75#x\nNs#\n").baseColour, glm::dvec3(0.25, 0.5, 0.75));
  EXPECT_TRUE(contains(errorIn("newmtl m\nd# 1.0\n"), "a.mtl:2"));
}

TEST(ReadMtl, FindsNamesWithComments) {
  const test::TemporaryFile file(".mtl", "newmtl red\nKd 1 0 0\nnewmtl blue#2\nKd 0 0 1\nnewmtl #8\nKd 0 0 0\n");
  SourceScene scene;
  scene.materials.resize(4);
  scene.materials[0].name = "red #comment";
  scene.materials[1].name = "blue";
  scene.materials[2].name = "green";
  scene.materials[3].name = "#9";
  describeMaterials(scene, file.path(), {file.path().filename().string()});
  EXPECT_EQ(scene.materials[0].baseColour, glm::dvec3(1, 0, 0));
  EXPECT_EQ(scene.materials[0].name, "red #comment");
  EXPECT_EQ(scene.materials[1].baseColour, glm::dvec3(0, 0, 1));
  EXPECT_EQ(scene.materials[2].baseColour, glm::dvec3(0.8));
  EXPECT_EQ(scene.materials[3].baseColour, glm::dvec3(0.8));
  ASSERT_EQ(scene.notes.size(), 4u);
  EXPECT_CONTAINS(scene.notes[0], "accepted", "\"red\"");
}

TEST(ReadMtl, ReadsTheImageOfTheColour) {
  const std::pair<const char*, const char*> kStatements[] = {
      {"map_Kd an image.png", "an image.png"},
      {"map_Kd -s 2 2 2 -o 0.5 -blendu on -clamp off -mm 0 1 wood.png ", "wood.png"},
      {"map_Kd -bm 0.5 a\\b.png", "a\\b.png"}};
  for (const auto& [statement, file] : kStatements) {
    const SourceMaterial material = one(std::string("Kd 0.5 0.5 0.5\n") + statement + "\n");
    ASSERT_EQ(images.size(), 1u) << statement;
    EXPECT_EQ(material.baseColourImage, 0u);
    EXPECT_EQ(images[0].name, file);
  }
  EXPECT_FALSE(one("Kd 0 0 0\nKs 1 1 1\nNs 100\nmap_Kd a.png\n").baseColourImage);  // a metal of colour Ks
  EXPECT_FALSE(one("map_Kd\n").baseColourImage);
  const test::TemporaryFile file(".mtl", "newmtl a\nmap_Kd textures\\wood.png\n");
  std::vector<SourceImage> found;
  readMtl(file.path(), notes, found);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].file, file.path().parent_path() / "textures" / "wood.png");
}

TEST(ReadMtl, NotesIgnoredStatementsOnce) {
  one("map_Ks b.png\nbump c.png\nfancy 1 2\nfancy 3\nKd spectral a.rfl\nKs xyz 1 1 1\n");
  ASSERT_EQ(notes.size(), 4u);
  EXPECT_CONTAINS(notes[0], "textures");
  EXPECT_CONTAINS(notes[1], "\"fancy\"");
  EXPECT_CONTAINS(notes[2], "spectral");
  EXPECT_CONTAINS(notes[3], "xyz");
}

TEST(ReadMtl, ReportsTheLineOfInvalidStatements) {
  EXPECT_CONTAINS(errorIn("newmtl a\n\nKd 1 nan 1\n"), "a.mtl:3", "number");
  EXPECT_CONTAINS(errorIn("newmtl a\nKd 1 1\n"), "a.mtl:2", "number");
  EXPECT_CONTAINS(errorIn("newmtl a\nNs\n"), "a.mtl:2", "number");
  EXPECT_CONTAINS(errorIn("newmtl a\nd 1e999\n"), "a.mtl:2", "range");
  EXPECT_CONTAINS(errorIn("newmtl a\nillum 11\n"), "a.mtl:2", "illumination");
  EXPECT_CONTAINS(errorIn("newmtl a\nillum two\n"), "a.mtl:2", "number");
  EXPECT_CONTAINS(errorIn("Kd 1 1 1\n"), "a.mtl:1", "outside");
  EXPECT_CONTAINS(errorIn("newmtl  \n"), "a.mtl:1", "name");
  EXPECT_CONTAINS(errorIn(std::string("newmtl a\n\0\nd 1\n", 15)), "a.mtl:2", "control");
  EXPECT_CONTAINS(errorIn("\xff\xfen"), "UTF-16");
  EXPECT_EQ(errorIn("\xef\xbb\xbfnewmtl a\n"), "");
  EXPECT_EQ(errorIn(""), "");
}

TEST(ReadMtl, LeavesOutInvalidStatements) {
  std::vector<std::string> found;
  const std::vector<SourceMaterial> materials =
      parseMtl("Kd 1 1 1\nnewmtl a\nKd 0.5 nan 0.5\nillum 99\nd 0.25\nnewmtl\nKd 0 0 0\nnewmtl b\nKd 0.5\n", "a.mtl",
               found, images);
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_EQ(materials[0].baseColour, glm::dvec3(0.8));
  EXPECT_EQ(materials[0].transmission, 0.75);
  EXPECT_EQ(materials[1].baseColour, glm::dvec3(0.5));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_CONTAINS(found[0], "invalid statements: 4", "a.mtl:1");
  EXPECT_CONTAINS(found[1], "invalid materials: 1", "a.mtl:6");
}

TEST(ReadMtl, ReportsValuesThatAreClamped) {
  for (const char* text : {"Kd 2 0 0\n", "Ks 0 -1 0\n", "d 1.5\n", "Tr -1\n", "Pm 3\n", "Ns -2\n", "Ke -1 0 0\n"}) {
    one(text);
    ASSERT_EQ(notes.size(), 1u) << text;
    EXPECT_CONTAINS(notes[0], "a.mtl:2", "out of range", std::string(text).substr(0, 2));
    EXPECT_CONTAINS(errorIn(std::string("newmtl m\n") + text), "a.mtl:2", "out of range");
  }
  one("Kd 1 0 1\nKs 1\nNs 1000\nKe 40 0 0\nd 1\n");
  EXPECT_TRUE(notes.empty());
}

TEST(ReadMtl, AMaterialFileThatIsUnreadableIsLeftOut) {
  const test::TemporaryFile file(".mtl", "\xff\xfen");
  SourceScene scene;
  scene.materials.resize(1);
  scene.materials[0].name = "red";
  const std::vector<std::string> files = {file.path().filename().string()};
  describeMaterials(scene, file.path(), files);
  EXPECT_EQ(scene.materials[0].baseColour, glm::dvec3(0.8));
  ASSERT_EQ(scene.notes.size(), 2u);
  EXPECT_CONTAINS(scene.notes[0], "material file", "UTF-16");
  EXPECT_CONTAINS(errorMessage([&] { describeMaterials(scene, file.path(), files, true); }), "UTF-16");
}

TEST(ReadMtl, AcceptsBlanksInNames) {
  std::vector<std::string> ignored;
  const auto materials = parseMtl("newmtl red  paint \nnewmtl b\xc3\xa4\n", "a.mtl", ignored, images);
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_EQ(materials[0].name, "red  paint");
  EXPECT_EQ(materials[1].name, "b\xc3\xa4");
  EXPECT_EQ(
      listMtllibs(
          "\xef\xbb\xbfmtllib my file \xc3\xa4.mtl\r\nv 0 0 0\n mtllib b.mtl\nmtllib \\\nb.mtl\n#mtllib c\nmtllib "
          "\xe4.mtl\nmtllib\n",
          "a.obj"),
      (std::vector<std::string>{"my file \xc3\xa4.mtl", "b.mtl", "\xc3\xa4.mtl"}));
}

TEST(ReadMtl, DescribesMaterialsByName) {
  const test::TemporaryFile file(".mtl", "newmtl red\nKd 1 0 0\nnewmtl red\nKd 0 1 0\n");
  SourceScene scene;
  scene.materials.resize(2);
  scene.materials[0].name = "red";
  scene.materials[1].name = "blue";
  describeMaterials(scene, file.path(), {file.path().filename().string(), "missing.mtl"});
  EXPECT_EQ(scene.materials[0].baseColour, glm::dvec3(1, 0, 0));
  EXPECT_EQ(scene.materials[1].baseColour, glm::dvec3(0.8));
  EXPECT_EQ(scene.materials[1].metallic, 0);
  ASSERT_EQ(scene.notes.size(), 3u);
  EXPECT_CONTAINS(scene.notes[0], "duplicate", "\"red\"");
  EXPECT_CONTAINS(scene.notes[1], "missing", "\"missing.mtl\"");
  EXPECT_CONTAINS(scene.notes[2], "\"blue\"", "description");
}

}  // namespace
}  // namespace malus::prep
