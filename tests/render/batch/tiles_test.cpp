// Frames in tiles: `malus merge` writes the files of the batch without tiles, byte by byte.
#include "render/batch/tiles.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "meshprep/base/error.h"
#include "render/batch/merge.h"
#include "render/batch/processor.h"
#include "render/batch/tile_files.h"
#include "render/sensor/sensor_file.h"
#include "tests/render/batch/batch_folder.h"

namespace malus::render {
namespace {

namespace fs = std::filesystem;

TEST(TileGrid, CoversEveryPixelOnce) {
  const FrameOutputs outputs;
  for (const Region& region : {Region{0, 0, 1, 1}, Region{0, 0, 256, 256}, Region{0, 0, 257, 255},
                               Region{3, 300, 515, 1030}, Region{0, 0, 5000, 3}}) {
    std::vector<int> hits(std::size_t{region.width} * region.height);
    const TileGrid grid(region, outputs);
    for (std::size_t tile = 0; tile < grid.count(); ++tile) {
      const Region part = grid[tile];
      EXPECT_EQ((part.x - region.x) % kFrameTileSide + (part.y - region.y) % kFrameTileSide, 0u);
      for (std::uint32_t y = part.y - region.y; y < part.y - region.y + part.height; ++y)
        for (std::uint32_t x = part.x - region.x; x < part.x - region.x + part.width; ++x)
          ++hits.at(std::size_t{y} * region.width + x);
    }
    EXPECT_EQ(std::ranges::count(hits, 1), static_cast<std::ptrdiff_t>(hits.size()));
  }
  EXPECT_EQ(TileGrid({0, 0, 257, 257}, outputs).count(), 4u);
  EXPECT_EQ(TileGrid({0, 0, 257, 257}, FrameOutputs({"camera"}, "")).count(), 1u);
}

// A shard with every N-th tile would otherwise have few columns, and perhaps all that take long.
TEST(TileGrid, SpreadsEveryShardOverTheColumns) {
  constexpr std::uint32_t kRows = 60;
  for (const std::uint32_t columns : {8u, 9u, 64u}) {
    const TileGrid grid({0, 0, columns * kFrameTileSide, kRows * kFrameTileSide}, FrameOutputs());
    for (std::size_t shards = 1; shards <= 66; ++shards) {
      std::vector<std::size_t> tiles(columns);
      for (std::size_t tile = 0; tile < grid.count(); tile += shards) ++tiles.at(grid[tile].x / kFrameTileSide);
      const std::size_t most = std::ranges::max(tiles), all = (grid.count() + shards - 1) / shards;
      EXPECT_LE(most, all / 2 + 1) << columns << " columns, " << shards << " shards";
    }
  }
}

// Tiles of odd sizes, one tile, no pixels, another projection, no Stokes vectors.
const std::string kJobs =
    R"({"name": "all", "width": 516, "height": 260, "outputs":
        ["exr", "png", "dolp", "aolp", "truth", "camera", "raw", "mask", "sensor-stokes"]}
       {"name": "odd", "width": 257, "height": 259, "samples": 2, "materials": {"gold": {"roughness": 0.2}}}
       {"name": "small", "polarizer": 30, "outputs": ["png", "exr", "truth"]}
       {"name": "camera", "outputs": ["camera"], "width": 5000}
       {"name": "truth", "outputs": ["truth"], "width": 300, "height": 7, "camera": {"orthographicHeight": 3}}
       {"name": "png", "outputs": ["png"], "width": 260, "height": 3, "exposure": -1.37, "lights": false}
    )";

// The jobs, each on one line.
std::string lines(std::string text) {
  for (std::size_t at = 0; (at = text.find("\n        ", at)) != std::string::npos;) text.replace(at, 9, " ");
  return text;
}

class Tiles : public test::BatchFolder {
 protected:
  // The name is not UTF-8, as of a file with the name of another system.
  static pack::Pack scenePack() {
    pack::Pack pack = test::batchPack();
    pack.scene.name = "caf\xe9";
    return pack;
  }
  BatchResult run(const std::string& folder, const std::string& text, bool tiles, Shard shard = {}) {
    FrameRenderer renderer(scenePack(), defaults_.job.backend, "", 1);
    return runBatch({sub(folder), defaults_, 0, shard, tiles}, jobs(lines(text)), renderer);
  }
  std::vector<fs::path> runShards(const std::string& text, std::uint64_t count) {
    std::vector<fs::path> parts;
    for (std::uint64_t k = 0; k < count; ++k) {
      run("part" + std::to_string(k), text, true, {k, count});
      parts.push_back(sub("part" + std::to_string(k)));
    }
    return parts;
  }
  void expectRefusal(const std::vector<fs::path>& parts, const std::vector<std::string>& words) {
    try {
      mergeBatches(parts, sub("refused"));
      ADD_FAILURE() << words[0];
    } catch (const Error& error) {
      for (const std::string& word : words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " / " << error.what();
    }
    EXPECT_TRUE(names(sub("refused")).empty()) << words[0];
  }

  FrameDefaults defaults_ = [] {
    FrameDefaults defaults = test::batchDefaults();
    Sensor sensor = readSensor("imx250myr");
    sensor.gain = 0.7;
    defaults.sensor = std::make_shared<const Sensor>(sensor);
    return defaults;
  }();
};

TEST_F(Tiles, MergeToTheSingleRun) {
  const BatchResult whole = run("whole", kJobs, false);
  EXPECT_EQ(whole.rendered, 6u);
  EXPECT_EQ(whole.tiles, 0u);
  const std::vector<fs::path> parts = runShards(kJobs, 3);
  const Manifest manifest = *readManifest(parts[0]);
  EXPECT_EQ(manifest.header.tileSide, kFrameTileSide);
  EXPECT_EQ(manifest.entries.size(), 6u);  // of 6 + 4 + 1 + 1 + 2 + 2 tiles
  for (const auto& [key, entry] : manifest.entries)
    for (const ManifestFile& file : entry.files) EXPECT_TRUE(isTileFileName(file.name)) << file.name;
  EXPECT_EQ(mergeBatches({parts[2], parts[0], parts[1]}, sub("merged")), 6u);
  expectEqualFolders(sub("merged"), sub("whole"));
  EXPECT_EQ(run("merged", kJobs, false).rendered, 0u) << "a merged folder is a finished batch";
}

TEST_F(Tiles, OfSingleRaysOfARegionByLossyCompression) {
  defaults_.job.embreePath = EmbreePath::scalar;
  defaults_.compression = image::ExrCompression::dwaa;
  defaults_.job.width = 400;
  defaults_.job.height = 300;
  defaults_.job.region = {11, 7, 259, 270};
  defaults_.job.tolerance = 0.05;
  const std::string text = "{\"outputs\": \"exr,truth\"}\n{\"method\": \"importance\", \"outputs\": \"png,aolp\"}\n";
  run("whole", text, false);
  mergeBatches(runShards(text, 2), sub("merged"));
  expectEqualFolders(sub("merged"), sub("whole"));
}

TEST_F(Tiles, OfTheReference) {
  defaults_.job.backend = Backend::reference;
  const std::string text = "{\"width\": 258, \"height\": 6}\n";
  run("whole", text, false);
  mergeBatches(runShards(text, 2), sub("merged"));
  expectEqualFolders(sub("merged"), sub("whole"));
}

TEST_F(Tiles, MoreShardsThanTiles) {
  const std::string text = "{\"width\": 300, \"height\": 9}\n";
  run("whole", text, false);
  const std::vector<fs::path> parts = runShards(text, 5);
  EXPECT_EQ(names(parts[4]), std::set<std::string>{"manifest.jsonl"});
  mergeBatches(parts, sub("merged"));
  expectEqualFolders(sub("merged"), sub("whole"));
}

TEST_F(Tiles, ContinueWhereTheyEnded) {
  const std::string text = "{\"width\": 520, \"height\": 260}\n";
  EXPECT_EQ(run("part", text, true).tiles, 6u);
  const std::string tile = bytes(sub("part") / "frame-000000.tile-0002.exr"),
                    manifest = bytes(sub("part") / kManifestFile);
  EXPECT_EQ(run("part", text, true).rendered, 0u);
  write(sub("part") / kManifestFile, manifest.substr(0, manifest.size() - 40));  // its last line has no end
  fs::remove(sub("part") / "frame-000000.tile-0002.exr");
  const BatchResult again = run("part", text, true);
  EXPECT_EQ(again.rendered, 2u);
  EXPECT_EQ(again.reused, 4u);
  EXPECT_TRUE(bytes(sub("part") / "frame-000000.tile-0002.exr") == tile);
  EXPECT_EQ(bytes(sub("part") / kManifestFile), manifest);
  fs::remove(sub("part") / "frame-000000.frame.json");
  EXPECT_EQ(run("part", text, true).rendered, 6u);
  EXPECT_EQ(bytes(sub("part") / kManifestFile), manifest);
  // A folder has whole frames or tiles.
  EXPECT_THROW(run("part", text, false), Error);
  run("whole", text, false);
  EXPECT_THROW(run("whole", text, true), Error);
}

TEST_F(Tiles, MergeRefusesWhatIsNotOneBatch) {
  const std::string text = "{\"width\": 520, \"height\": 2}\n{\"name\": \"b\", \"width\": 2, \"height\": 2}\n";
  const std::vector<fs::path> parts = runShards(text, 2);  // tiles 0, 2 of the first frame; tile 1 and the second
  expectRefusal({parts[0]}, {"1 of 3 tiles", "frame 0", "the first is tile 1"});
  expectRefusal({parts[0], parts[1], parts[1]}, {"tile 1 of frame 0", "is also in", parts[1].string()});
  run("whole", text, false);
  expectRefusal({parts[0], parts[1], sub("whole")}, {"whole frames", "--tiles"});

  const Manifest manifest = *readManifest(parts[1]);
  const auto expectChanged = [&](const auto& change, const std::vector<std::string>& words) {
    Manifest changed = manifest;
    change(changed);
    writeManifest(parts[1], changed);
    expectRefusal(parts, words);
    writeManifest(parts[1], manifest);
  };
  expectChanged([](Manifest& m) { m.entries.erase({1, 0}); }, {"no tile of frame 1"});
  expectChanged(
      [](Manifest& m) {
        m.entries[{2, 0}] = m.entries.at({1, 0}), m.entries[{2, 0}].index = 2;
      },
      {"frame 2 is beyond"});
  expectChanged(
      [](Manifest& m) {
        m.entries[{0, 3}] = m.entries.at({0, 1}), m.entries[{0, 3}].tile = 3;
      },
      {"tile 3 of frame 0", "beyond"});
  expectChanged([](Manifest& m) { m.header.producer.processor = "avx9"; }, {"processor", "avx9"});
  expectChanged([](Manifest& m) { m.entries.at({0, 1}).seed = 77; }, {"tile 1 of frame 0", "other settings"});
  expectChanged([](Manifest& m) { m.entries.at({0, 1}).settings["depth"] = 1; }, {"hash of frame 0"});
  expectChanged([](Manifest& m) { m.entries.at({1, 0}).name = "../b"; }, {"other files"});
  // A shard of other settings, with its own hash.
  expectChanged(
      [](Manifest& m) {
        ManifestEntry& entry = m.entries.at({0, 1});
        entry.settings["depth"] = 1;
        entry.hash = frameHash(entry.settings, m.header.pack, m.header.producer.program);
      },
      {"tile 1 of frame 0", "other settings"});

  for (const char* name : {"frame-000000.tile-0001.exr", "frame-000000.frame.json"}) {
    const std::string whole = bytes(parts[1] / name);
    std::string damaged = whole;
    damaged[damaged.size() / 2] ^= 1;
    write(parts[1] / name, damaged);
    expectRefusal(parts, {name, "remove it", "malus batch"});
    fs::remove(parts[1] / name);
    expectRefusal(parts, {name});
    write(parts[1] / name, whole);
  }
  mergeBatches(parts, sub("merged"));
  expectEqualFolders(sub("merged"), sub("whole"));
}

// The files of a merge depend on the processor that writes them.
TEST_F(Tiles, MergeOnAnotherProcessorIsRefused) {
  const std::vector<fs::path> parts = runShards("{}\n", 1);
  Manifest manifest = *readManifest(parts[0]);
  manifest.header.producer.processor = "avx9";
  writeManifest(parts[0], manifest);
  expectRefusal(parts, {"processor", "avx9", processorFeatures()});
  manifest.header.producer = readManifest(parts[0])->header.producer;
  manifest.header.producer.processor = processorFeatures();
  manifest.header.producer.program = "malus 0";
  writeManifest(parts[0], manifest);
  expectRefusal(parts, {"program", "malus 0"});
}

}  // namespace
}  // namespace malus::render
