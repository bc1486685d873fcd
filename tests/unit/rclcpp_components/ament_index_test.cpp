// SPDX-License-Identifier: Apache-2.0
// The places where packages and resources are found.
#include <gmock/gmock.h>

#include <ament_index_cpp/get_package_share_directory.hpp>
#include <ament_index_cpp/get_packages_with_prefixes.hpp>
#include <ament_index_cpp/get_resource.hpp>
#include <ament_index_cpp/get_resources.hpp>
#include <ament_index_cpp/get_search_paths.hpp>
#include <ament_index_cpp/has_resource.hpp>
#include <cstdlib>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using testing::Contains;
using testing::Key;
using testing::Pair;

class AmentIndex : public testing::Test {
 protected:
  AmentIndex() {
    add(first_, "packages", "arm", "");
    add(second_, "packages", "arm", "");
    add(second_, "packages", "hand", "");
    add(second_, "tools", "hand", "saw\nhammer\n");
    add(second_, "tools", ".hidden", "");
    setenv("AMENT_PREFIX_PATH", (first_ + ":/nowhere::" + second_).c_str(), 1);
  }
  ~AmentIndex() override { unsetenv("AMENT_PREFIX_PATH"); }

  static void add(const std::string& prefix, const std::string& type, const std::string& name,
                  const std::string& content) {
    const auto folder = std::filesystem::path(prefix) / "share/ament_index/resource_index" / type;
    std::filesystem::create_directories(folder);
    test_support::write_file(folder / name, content);
  }

  test_support::Sandbox sandbox_;
  const std::string first_ = (sandbox_.directory() / "first").string();
  const std::string second_ = (sandbox_.directory() / "second").string();
};

TEST_F(AmentIndex, SearchesThePathInOrderAndThenItsOwnPrefix) {
  const auto paths = ament_index_cpp::get_search_paths();
  ASSERT_EQ(paths.size(), 3u);
  EXPECT_EQ(paths.front(), first_);
  EXPECT_EQ(*std::next(paths.begin()), second_);
  EXPECT_EQ(ament_index_cpp::get_package_prefix("ament_index_cpp"), paths.back());
  unsetenv("AMENT_PREFIX_PATH");
  EXPECT_EQ(ament_index_cpp::get_search_paths(), std::list<std::string>{paths.back()});
}

TEST_F(AmentIndex, FirstPrefixWins) {
  EXPECT_EQ(ament_index_cpp::get_package_prefix("arm"), first_);
  EXPECT_EQ(ament_index_cpp::get_package_share_directory("hand"), second_ + "/share/hand");
  const auto packages = ament_index_cpp::get_packages_with_prefixes();
  EXPECT_THAT(packages, Contains(Pair("arm", first_)));
  EXPECT_THAT(packages, Contains(Pair("hand", second_)));
  EXPECT_THAT(packages, Contains(Key("rclcpp")));
}

TEST_F(AmentIndex, ResourcesHaveContent) {
  std::string content = "unchanged";
  std::string prefix;
  EXPECT_FALSE(ament_index_cpp::get_resource("tools", "arm", content, &prefix));
  EXPECT_EQ(content, "unchanged");
  EXPECT_TRUE(ament_index_cpp::get_resource("tools", "hand", content, &prefix));
  EXPECT_EQ(content, "saw\nhammer\n");
  EXPECT_EQ(prefix, second_);
  EXPECT_TRUE(ament_index_cpp::has_resource("tools", "hand"));
  EXPECT_EQ(ament_index_cpp::get_resources("tools"), (std::map<std::string, std::string>{{"hand", second_}}));
}

TEST_F(AmentIndex, ErrorsNameWhatWasSearched) {
  try {
    ament_index_cpp::get_package_prefix("leg");
    FAIL() << "the package was found";
  } catch (const ament_index_cpp::PackageNotFoundError& error) {
    EXPECT_EQ(error.package_name, "leg");
    EXPECT_EQ(std::string(error.what()), "package 'leg' not found, searching: [" + first_ + ", " + second_ + ", " +
                                             ament_index_cpp::get_search_paths().back() + "]");
  }
  EXPECT_FALSE(ament_index_cpp::has_resource("tools", "../packages/hand"));
  EXPECT_THROW(ament_index_cpp::has_resource("tools", ""), std::runtime_error);
  EXPECT_THROW(ament_index_cpp::get_resources(""), std::runtime_error);
}

}  // namespace
