// SPDX-License-Identifier: Apache-2.0
#include "base/environment/runtime_directory.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

namespace launch {
namespace {

namespace fs = std::filesystem;

class RuntimeDirectoryTest : public testing::Test {
 protected:
  RuntimeDirectoryTest() {
    std::string pattern = testing::TempDir() + "runtime-XXXXXX";
    base_ = ::mkdtemp(pattern.data());
    environment_ = Environment{{"XDG_RUNTIME_DIR", base_.string()}};
  }
  ~RuntimeDirectoryTest() override { fs::remove_all(base_); }

  bool finds_ours() const {
    for (const RuntimeDirectory& found : RuntimeDirectory::find(environment_)) {
      if (found.path == ours()) {
        return true;
      }
    }
    return false;
  }
  std::string ours() const { return base_ / "launch"; }

  fs::path base_;
  Environment environment_;
};

TEST_F(RuntimeDirectoryTest, IsMadeForTheOwnerAlone) {
  EXPECT_FALSE(finds_ours());
  EXPECT_EQ(RuntimeDirectory::make(environment_).path, ours());
  struct stat status {};
  ASSERT_EQ(::stat(ours().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0700U);
  EXPECT_TRUE(finds_ours());
  EXPECT_EQ(RuntimeDirectory::make(environment_).path, ours()) << "it is used again";
}

TEST_F(RuntimeDirectoryTest, ADirectoryThatOthersMayEnterIsNotTrusted) {
  ASSERT_EQ(::mkdir(ours().c_str(), 0700), 0);
  ASSERT_EQ(::chmod(ours().c_str(), 0770), 0);
  EXPECT_FALSE(finds_ours());
  EXPECT_NE(RuntimeDirectory::make(environment_).path, ours());
}

TEST_F(RuntimeDirectoryTest, ALinkIsNotFollowed) {
  fs::create_directory(base_ / "elsewhere");
  fs::permissions(base_ / "elsewhere", fs::perms::owner_all);
  fs::create_symlink("elsewhere", ours());
  EXPECT_FALSE(finds_ours());
  EXPECT_NE(RuntimeDirectory::make(environment_).path, ours());
}

TEST_F(RuntimeDirectoryTest, WithoutTheVariableItIsBelowTmp) {
  const RuntimeDirectory made = RuntimeDirectory::make({});
  EXPECT_EQ(made.path, fmt::format("/tmp/launch-{}", ::geteuid()));
  environment_ = Environment{{"XDG_RUNTIME_DIR", "/no/such/directory"}};
  EXPECT_EQ(RuntimeDirectory::make(environment_).path, made.path);
}

TEST_F(RuntimeDirectoryTest, AnAddressIsShortForEveryDirectory) {
  const fs::path deep = base_ / std::string(200, 'd');
  fs::create_directory(deep);
  environment_ = Environment{{"XDG_RUNTIME_DIR", deep.string()}};
  EXPECT_LT(RuntimeDirectory::make(environment_).address("4194304-0123456789abcdef.sock").size(), 108U);
}

}  // namespace
}  // namespace launch
