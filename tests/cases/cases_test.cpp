// Runs the commands of each case and checks what they do (README.md beside this file).
#include <map>

#include <nlohmann/json.hpp>

#include "tests/cases/checks.h"
#include "tests/tools/command.h"

namespace malus::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string replaceAll(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

// Replaces {NAME} in all keys and texts; a text that is {NAME} alone becomes the value itself.
json substitute(const json& tree, const json& values) {
  if (tree.is_string()) {
    std::string text = tree;
    for (const auto& [name, value] : values.items()) {
      const std::string mark = "{" + name + "}";
      if (text == mark) return value;
      text = replaceAll(text, mark, value.is_string() ? value.get<std::string>() : value.dump());
    }
    return text;
  }
  if (tree.is_array()) {
    json list = json::array();
    for (const json& element : tree) list.push_back(substitute(element, values));
    return list;
  }
  if (!tree.is_object()) return tree;
  json object = json::object();
  for (const auto& [key, value] : tree.items())
    object[substitute(key, values).get<std::string>()] = substitute(value, values);
  return object;
}

std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    files[entry.path()] = entry.is_regular_file() ? readText(entry.path()) : "";
  return files;
}

void checkStreams(const Finished& finished, const json& command) {
  EXPECT_EQ(finished.exitCode, command.value("exit", 0)) << finished.err << "signal " << finished.signal;
  for (const std::string text : command.value("stdout", json::array()))
    EXPECT_TRUE(contains(finished.out, text)) << "no '" << text << "' on stdout:\n" << finished.out;
  for (const std::string text : command.value("stderr", json::array()))
    EXPECT_TRUE(contains(finished.err, text)) << "no '" << text << "' on stderr:\n" << finished.err;
  for (const std::string text : command.value("without", json::array()))
    EXPECT_FALSE(contains(finished.out, text) || contains(finished.err, text)) << "'" << text << "' in the output:\n"
                                                                               << finished.out << finished.err;
  if (!command.contains("json")) return;
  const json printed = json::parse(finished.out);
  for (const auto& [pointer, expected] : command["json"].items())
    checkValue(printed.at(json::json_pointer(pointer)), expected, pointer);
}

void runCommand(const json& command, const fs::path& folder) {
  SCOPED_TRACE(command.at("run").get<std::string>());
  expectKeys(command, {"run", "for", "exit", "stdout", "stderr", "without", "changesNothing", "exists", "absent",
                       "json", "texts", "images", "meshes"});
  std::istringstream words(command["run"].get<std::string>());
  std::vector<std::string> arguments;
  for (std::string word; words >> word;) arguments.push_back(word);
  const std::map<std::string, std::string> before = contents(folder);
  checkStreams(malus(arguments, {.workingFolder = folder}), command);
  const bool changesNothing = command.value("changesNothing", false);
  EXPECT_TRUE(!changesNothing || contents(folder) == before) << "files have changed";
  for (const std::string name : command.value("exists", json::array())) EXPECT_TRUE(fs::exists(folder / name)) << name;
  for (const std::string name : command.value("absent", json::array())) EXPECT_FALSE(fs::exists(folder / name)) << name;
  using Check = void (*)(const fs::path&, const json&);
  for (const auto& [key, check] :
       {std::pair<const char*, Check>("texts", checkText), {"images", checkImage}, {"meshes", checkMesh}}) {
    const json files = command.value(key, json::object());
    for (const auto& [name, expected] : files.items()) check(folder / name, expected);
  }
}

class Case : public testing::TestWithParam<std::string> {};

TEST_P(Case, IsRight) {
  const Folder folder;
  fs::copy(fs::path(MALUS_CASES) / GetParam(), folder.path(), fs::copy_options::recursive);
  const json commands = json::parse(readText(folder / "case.json")).at("commands");
  ASSERT_FALSE(commands.empty());
  for (const json& command : commands)
    for (const json& values : command.value("for", json::array({json::object()}))) {
      json once = command;
      once.erase("for");
      runCommand(substitute(once, values), folder.path());
    }
}

std::vector<std::string> caseNames() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(MALUS_CASES))
    if (entry.is_directory()) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, Case, testing::ValuesIn(caseNames()),
                         [](const auto& instance) { return replaceAll(instance.param, "-", "_"); });

}  // namespace
}  // namespace malus::test
