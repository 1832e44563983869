#include "meshprep/base/cache_folder.h"

#include <cstdlib>
#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace malus {
namespace {

// Sets or unsets a variable and restores it on scope exit.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    set(value);
  }
  ~Variable() { set(old_ ? old_->c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const char* value) {
    if (value)
      ::setenv(name_, value, 1);
    else
      ::unsetenv(name_);
  }
  const char* name_;
  std::optional<std::string> old_;
};

TEST(CacheFolder, FollowsTheXdgRule) {
  const Variable home("HOME", "/home/user");
  {
    const Variable cache("XDG_CACHE_HOME", "/caches");
    EXPECT_EQ(cacheFolder("spirv"), "/caches/malus/spirv");
  }
  for (const char* ignored : {static_cast<const char*>(nullptr), "", "relative/folder"}) {
    const Variable cache("XDG_CACHE_HOME", ignored);
    EXPECT_EQ(cacheFolder("spirv"), "/home/user/.cache/malus/spirv");
  }
}

TEST(CacheFolder, IsEmptyWithoutHome) {
  const Variable cache("XDG_CACHE_HOME", nullptr);
  for (const char* unset : {static_cast<const char*>(nullptr), ""}) {
    const Variable home("HOME", unset);
    EXPECT_TRUE(cacheFolder("spirv").empty());
  }
}

}  // namespace
}  // namespace malus
