// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/description/description_file.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/twin/small_system.hpp"

namespace tracing::twin {
namespace {

using testing::kMs;
using testing::SmallSystem;

System example() {
  SmallSystem small;
  small.add_timer("/one, timer 10 ms", 10 * kMs, 2 * kMs);
  const Index topic = small.publish(0, "/a", 0.5);
  const Index group = small.add_process("/two");
  small.add_subscription("/two, subscription /a", topic, kMs, kMs / 2, group);
  small.publish(1, "/b", 1);
  small.system.callbacks[1].outputs[0].rule = Output::Rule::kJoin;
  small.system.callbacks[1].outputs[0].inputs = {1};
  small.system.executors[1] = {1, Executor::Kind::kMulti, 3, 7};
  small.system.missing.push_back("a sentence");
  small.system.duration_ns = 1'000;
  return small.system;
}

TEST(DescriptionFile, IsReadAsItWasWritten) {
  const System system = example();
  const std::string text = description_of(system);
  const System read = parse_description(text, "here");
  EXPECT_EQ(description_of(read), text);
  EXPECT_EQ(read.executors[1], system.executors[1]);
  EXPECT_EQ(read.callbacks[1].outputs[0].inputs, std::vector<Index>{1});
}

TEST(DescriptionFile, RefusesWhatDescribesNoTwin) {
  const std::string text = description_of(example());
  const auto error = [&](const std::string& old, const std::string& changed) -> std::string {
    std::string other = text;
    other.replace(other.find(old), old.size(), changed);
    try {
      parse_description(other, "twin.json");
    } catch (const std::runtime_error& refused) {
      return refused.what();
    }
    return "";
  };
  EXPECT_NE(error("\"version\": 1", "\"version\": 2").find("another version"), std::string::npos);
  EXPECT_NE(error("\"multi\"", "\"many\"").find("'many' is none of the known words"), std::string::npos);
  EXPECT_NE(error("\"topic\": 0", "\"topic\": 9").find("the index 9 is too large"), std::string::npos);
  EXPECT_NE(error("{", "").find("twin.json does not describe a twin"), std::string::npos);
  EXPECT_THROW(read_description("/nowhere/twin.json"), std::runtime_error);
}

}  // namespace
}  // namespace tracing::twin
