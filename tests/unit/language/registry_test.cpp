// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/registry.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "launcher/language/launch_description.hpp"

namespace launch {
namespace {

TEST(Registry, ATagIsDeclaredOnce) {
  Registry registry;
  ActionType type;
  type.tag = "wave";
  registry.add(type);
  EXPECT_THROW(registry.add(type), std::logic_error);
  ASSERT_NE(registry.find("wave"), nullptr);
  EXPECT_EQ(registry.find("weave"), nullptr);
}

TEST(Registry, AFileOfALoadersEndingIsLoadedByIt) {
  Registry registry;
  registry.add_loader(".program", [](std::shared_ptr<const SourceFile> file, const Registry&, const Scope&) {
    auto description = std::make_shared<LaunchDescription>();
    description->deprecated = "loaded";
    description->file = std::move(file);
    return description;
  });
  const auto file = std::make_shared<SourceFile>("/test/a.launch.program", "<launch/>");
  EXPECT_EQ(parse_launch_description(file, registry)->deprecated, "loaded");
  const auto other = std::make_shared<SourceFile>("/test/a.launch.xml", "<launch/>");
  EXPECT_EQ(parse_launch_description(other, registry)->deprecated, "");
}

}  // namespace
}  // namespace launch
