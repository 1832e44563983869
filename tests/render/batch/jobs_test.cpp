#include "render/batch/jobs.h"

#include <unistd.h>

#include <fstream>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/batch/csv.h"

namespace malus::render {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path write(const std::string& name, const std::string& text) {
  const fs::path path = fs::path(testing::TempDir()) / (std::to_string(::getpid()) + name);
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

Jobs readJobs(const std::string& name, const std::string& text, std::uint64_t seed = 0) {
  return {readJobLines(write(name, text)), seed};
}

// Expects an Error with all key words.
void expectError(const std::string& name, const std::string& text, const std::vector<std::string>& words) {
  try {
    const Jobs jobs = readJobs(name, text);
    for (std::size_t i = 0; i < jobs.size(); ++i) jobs.draw(i);
    ADD_FAILURE() << text;
  } catch (const Error& error) {
    for (const std::string& word : words)
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " / " << error.what();
  }
}

TEST(Csv, FieldsFollowRfc4180) {
  const std::vector<CsvRow> rows = parseCsv(
      "\xef\xbb\xbf"
      "a,\"b,\"\"c\"\"\",\r\n\n\"two\nlines\",2,3\n4,5,6",
      "t.csv");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].fields, (std::vector<std::string>{"a", "b,\"c\"", ""}));
  EXPECT_EQ(rows[1].fields, (std::vector<std::string>{"two\nlines", "2", "3"}));
  EXPECT_EQ(rows[1].line, 3u);
  EXPECT_EQ(rows[2].line, 5u);
  EXPECT_THROW(parseCsv("a,\"b", "t.csv"), Error);
  EXPECT_THROW(parseCsv("\"a\"b", "t.csv"), Error);
}

TEST(Jobs, LinesAreFrames) {
  const Jobs jobs =
      readJobs("a.jsonl", "{\"name\": \"first\", \"width\": 8}\n\n  \r\n{\"repeat\": 11, \"name\": \"n\"}\n{}");
  ASSERT_EQ(jobs.size(), 13u);
  EXPECT_EQ(jobs.name(0), "first");
  EXPECT_EQ(jobs.name(1), "n-00");
  EXPECT_EQ(jobs.name(11), "n-10");
  EXPECT_EQ(jobs.name(12), "frame-000012");
  const FrameJob job = jobs.draw(0);
  EXPECT_EQ(job.settings, json({{"width", 8}}));
  EXPECT_TRUE(job.where.ends_with("a.jsonl:1"));
  EXPECT_TRUE(jobs.draw(12).where.ends_with("a.jsonl:5"));
}

TEST(Jobs, TablesSetPaths) {
  const Jobs table = readJobs("a.csv",
                              "name,camera.position,camera.target,materials.gold.roughness,width,effects\n"
                              "007,1 2 3,\"[0,0,0]\",uniform 0.1 0.2,16,\"metal,shadows\"\n"
                              "b,,,list 0.5 0.6,,auto\n",
                              3);
  const Jobs lines = readJobs("b.jsonl",
                              "{\"name\": \"007\", \"camera\": {\"position\": [1, 2, 3], \"target\": [0, 0, 0]}, "
                              "\"materials\": {\"gold\": {\"roughness\": {\"uniform\": [0.1, 0.2]}}}, \"width\": 16, "
                              "\"effects\": \"metal,shadows\"}\n"
                              "{\"name\": \"b\", \"materials\": {\"gold\": {\"roughness\": {\"list\": [0.5, 0.6]}}}, "
                              "\"effects\": \"auto\"}",
                              3);
  ASSERT_EQ(table.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(table.draw(i).settings, lines.draw(i).settings);
    EXPECT_EQ(table.name(i), lines.name(i));
  }
  EXPECT_TRUE(table.draw(0).settings.at("width").is_number_integer());
}

TEST(Jobs, ValuesDoNotDependOnTheOrderOfDrawing) {
  const std::string text = "{\"repeat\": 50, \"polarizer\": {\"uniform\": [0, 180]}}";
  const Jobs jobs = readJobs("c.jsonl", text, 9), again = readJobs("d.jsonl", text, 9);
  std::vector<json> forward(50), backward(50);
  for (std::size_t i = 0; i < 50; ++i) forward[i] = jobs.draw(i).settings;
  for (std::size_t i = 50; i-- > 0;) backward[i] = again.draw(i).settings;
  EXPECT_EQ(forward, backward);
  EXPECT_NE(forward[0], forward[1]);
}

TEST(Jobs, RefusesBadFiles) {
  expectError("e.jsonl", "{\"name\": \"a\"}\n{\"name\": ", {"e.jsonl:2", "JSON"});
  expectError("e.jsonl", "[1]", {"e.jsonl:1", "object"});
  expectError("e.jsonl", "{\"a\": 1, \"a\": 2}", {"e.jsonl:1", "'a'", "twice"});
  expectError("e.jsonl", "{\"m\": {\"a\": 1, \"b\": {\"a\": 2}, \"a\": 3}}", {"'a'", "twice"});
  expectError("e.jsonl", "{\"name\": \"a\"}\n{\"name\": \"a\"}", {"e.jsonl:2", "'a'", "e.jsonl:1"});
  expectError("e.jsonl", "{\"name\": \"a\", \"repeat\": 2}\n{\"name\": \"a-1\"}", {"e.jsonl:2", "'a-1'"});
  for (const char* name : {"../a", "a/b", "", ".a", "-a", "a.b", "\\u0007"})
    expectError("e.jsonl", std::string("{\"name\": \"") + name + "\"}", {"e.jsonl:1", "name"});
  for (const char* repeat : {"0", "-1", "1.5", "\"2\"", "1000000000"})
    expectError("e.jsonl", std::string("{\"repeat\": ") + repeat + "}", {"e.jsonl:1", "repeat"});
  expectError("e.jsonl", "\n\n", {"no jobs"});
  expectError("e.csv", "", {"empty"});
  expectError("e.csv", "name\n", {"no jobs"});
  expectError("e.csv", "name,width\na\n", {"e.csv:2", "2 fields", "1"});
  expectError("e.csv", "name,name\na,b\n", {"e.csv:1", "twice"});
  expectError("e.csv", "name,\na,b\n", {"e.csv:1", "name"});
  expectError("e.csv", "camera,camera.position\n5,1 2 3\n", {"e.csv:2", "camera.position"});
  expectError("e.csv", "camera.pose\n\"[[1,2\"\n", {"e.csv:2", "camera.pose", "JSON"});
  expectError("e.txt", "{}", {".jsonl", ".csv", ".txt"});
}

}  // namespace
}  // namespace malus::render
