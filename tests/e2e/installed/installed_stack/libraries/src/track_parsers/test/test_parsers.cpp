// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <pluginlib/class_loader.hpp>

#include "track_parsers/parser.hpp"

TEST(Parsers, AreFoundBeforeTheyAreInstalled) {
  pluginlib::ClassLoader<track_parsers::Parser> loader("track_parsers", "track_parsers::Parser");
  const auto parser = loader.createSharedInstance("track_parsers/Yaml");
  EXPECT_EQ(parser->width("width: 12"), 12);
  EXPECT_EQ(parser->width("{}"), 640);
}
