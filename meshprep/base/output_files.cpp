#include "meshprep/base/output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "meshprep/base/usage_error.h"

namespace malus {
namespace fs = std::filesystem;

namespace {

fs::path parentFolder(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

// A file that exists (empty rest), or the deepest folder of its path that exists and the rest of the path.
struct Identity {
  dev_t device = 0;
  ino_t inode = 0;
  fs::path anchor, rest;

  bool exists() const { return rest.empty(); }
  bool sharesAnchor(const Identity& other) const { return device == other.device && inode == other.inode; }
};

Identity identify(const fs::path& path) {
  std::error_code ignored;
  fs::path anchor = fs::absolute(resolveLinks(path), ignored), rest;
  struct stat info {};
  while (::stat(anchor.c_str(), &info) != 0) {
    rest = rest.empty() ? anchor.filename() : anchor.filename() / rest;
    const fs::path parent = anchor.parent_path();
    if (parent == anchor) return {0, 0, anchor, rest.lexically_normal()};
    anchor = parent;
  }
  return {info.st_dev, info.st_ino, anchor, rest.lexically_normal()};
}

// Returns true if the file system could take both names for one file: they are equal but for the case of ASCII letters,
// or have other characters, for which every file system has its own rules.
bool mayBeEqual(const std::string& a, const std::string& b) {
  const auto isOther = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
  if (std::any_of(a.begin(), a.end(), isOther) && std::any_of(b.begin(), b.end(), isOther)) return true;
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

// Asks the file system of a folder whether two relative paths name one file. A folder that is not writable: no.
bool areOneFile(const fs::path& folder, const fs::path& a, const fs::path& b) {
  std::string probe = (folder / ".malus-names-XXXXXX").string();
  if (::mkdtemp(probe.data()) == nullptr) return false;
  std::error_code ignored;
  fs::create_directories(parentFolder(probe / a), ignored);
  { const std::ofstream file(probe / a); }
  const bool same = fs::exists(probe / b, ignored);
  fs::remove_all(probe, ignored);
  return same;
}

bool areSame(const Identity& a, const Identity& b) {
  if (!a.sharesAnchor(b) || a.exists() != b.exists()) return false;
  if (a.rest == b.rest) return true;
  return mayBeEqual(a.rest.string(), b.rest.string()) && areOneFile(a.anchor, a.rest, b.rest);
}

// Throws UsageError unless the path is a regular file (or, as asked, a folder), or may become one.
void requireKind(const fs::path& path, const std::string& option, bool isFolder) {
  const fs::path resolved = resolveLinks(path);
  std::error_code ignored;
  const fs::file_status status = fs::status(resolved, ignored);
  const char* expected = isFolder ? "a folder, or a new name" : "a regular file, or a new name";
  if (fs::is_block_file(status) || fs::is_character_file(status))
    throw UsageError(option, fmt::format("{} is a device", path.string()), expected);
  if (fs::is_fifo(status) || fs::is_socket(status))
    throw UsageError(option, fmt::format("{} is a pipe or a socket", path.string()), expected);
  if (isFolder && fs::is_regular_file(status))
    throw UsageError(option, fmt::format("{} is a file", path.string()), expected);
  // A mistyped name of a disk must not become a file in memory.
  if (!fs::exists(status) && fs::weakly_canonical(resolved, ignored).parent_path() == "/dev")
    throw UsageError(option, fmt::format("{} would be a file among the devices", path.string()), "another folder");
}

}  // namespace

fs::path resolveLinks(const fs::path& path) {
  constexpr int kMaxLinks = 40;  // as the kernel's MAXSYMLINKS
  fs::path resolved = path;
  std::error_code failed;
  for (int i = 0; i < kMaxLinks && fs::is_symlink(resolved, failed); ++i) {
    const fs::path target = fs::read_symlink(resolved, failed);
    if (failed) break;
    // Links in /proc, such as /proc/self/fd/1, may name no path: "pipe:[123]".
    const fs::path next = target.is_absolute() ? target : parentFolder(resolved) / target;
    if (!fs::exists(next, failed) && fs::exists(resolved, failed)) break;
    resolved = next;
  }
  return resolved;
}

void OutputFiles::addInput(const fs::path& file) {
  if (!file.empty()) inputs_.push_back(file);
}

void OutputFiles::addOutput(const fs::path& file, std::string_view option) {
  if (!file.empty()) outputs_.push_back({file, std::string(option)});
}

void OutputFiles::addOutputFolder(const fs::path& folder, std::string_view option) {
  if (!folder.empty()) folders_.push_back({folder, std::string(option)});
}

void OutputFiles::check() const {
  for (const Output& folder : folders_) requireKind(folder.file, folder.option, true);
  for (const Output& output : outputs_) requireKind(output.file, output.option, false);
  std::vector<Identity> inputs, outputs;
  for (const fs::path& file : inputs_) inputs.push_back(identify(file));
  for (const Output& output : outputs_) outputs.push_back(identify(output.file));
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const auto& [file, option] = outputs_[i];
    for (std::size_t j = 0; j < inputs.size(); ++j)
      if (areSame(outputs[i], inputs[j]))
        throw UsageError(option, fmt::format("{} would overwrite the input {}", file.string(), inputs_[j].string()),
                         "another file");
    for (std::size_t j = 0; j < i; ++j)
      if (areSame(outputs[i], outputs[j]))
        throw UsageError(option,
                         fmt::format("{} is the same file as {} of {}", file.string(), outputs_[j].file.string(),
                                     outputs_[j].option),
                         "a file for each output");
  }
}

}  // namespace malus
