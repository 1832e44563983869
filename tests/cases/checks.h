// Checks of the files that a command of a case has written (README.md beside this file). Failures are added to the
// running test.
#pragma once

#include <filesystem>

#include <nlohmann/json.hpp>

namespace malus::test {

// Fails if an object has another key than these.
void expectKeys(const nlohmann::json& object, std::initializer_list<const char*> known);

void checkValue(const nlohmann::json& found, const nlohmann::json& expected, const std::string& name);
void checkText(const std::filesystem::path& file, const nlohmann::json& expected);
void checkImage(const std::filesystem::path& file, const nlohmann::json& expected);
void checkMesh(const std::filesystem::path& file, const nlohmann::json& expected);

}  // namespace malus::test
