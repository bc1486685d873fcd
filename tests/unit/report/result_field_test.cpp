// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <type_traits>

#include "tracing/model/analysis/results/field.hpp"

namespace tracing {
namespace {

constexpr const char* kSizes[] = {"small", "large"};

struct Sample {
  std::string name;
  std::uint64_t count = 0;
  bool is_named() const { return !name.empty(); }
  const char* size() const { return kSizes[count > 9 ? 1 : 0]; }
  double half() const { return static_cast<double>(count) / 2; }

  static const Field<Sample> kFields[];
};
constexpr Field<Sample> Sample::kFields[] = {
    {"name", &Sample::name, "", trait::kNotOnPage, &Sample::is_named},
    {"count", &Sample::count, "how many"},
    {"size", {&Sample::size, kSizes}, ""},
    {"half", &Sample::half, ""},
};

// What an output sees of a result: "count=3".
std::vector<std::string> seen(const Sample& sample) {
  std::vector<std::string> lines;
  for (const Field<Sample>& field : Sample::kFields) {
    if (!field.is_in(sample)) {
      continue;
    }
    std::string line = field.name + std::string("=");
    field.member.visit([&](auto member) {
      const auto& value = std::invoke(member, sample);
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_arithmetic_v<Value>) {
        line += std::to_string(value);
      } else if constexpr (std::is_convertible_v<Value, std::string>) {
        line += value;
      }
    });
    lines.push_back(line);
  }
  return lines;
}

TEST(ResultField, GivesTheValueOfAMemberOrAFunction) {
  EXPECT_EQ(seen({"a", 12}), (std::vector<std::string>{"name=a", "count=12", "size=large", "half=6.000000"}));
}

TEST(ResultField, IsLeftOutWhereItsConditionDoesNotHold) {
  EXPECT_EQ(seen({"", 3}), (std::vector<std::string>{"count=3", "size=small", "half=1.500000"}));
}

TEST(ResultField, LetsTextsBeChanged) {
  Sample sample{"a", 1};
  *Sample::kFields[0].member.text_in(sample) = "b";
  EXPECT_EQ(sample.name, "b");
  EXPECT_EQ(Sample::kFields[1].member.text_in(sample), nullptr);
}

TEST(ResultField, KnowsItsTraitsAndWords) {
  EXPECT_TRUE(Sample::kFields[0].has(trait::kNotOnPage | trait::kTime));
  EXPECT_FALSE(Sample::kFields[1].has(trait::kNotOnPage));
  EXPECT_EQ(Sample::kFields[2].member.words().size(), 2u);
  EXPECT_TRUE(Sample::kFields[1].member.words().empty());
}

TEST(ResultField, TheProcessNumberStandsBesideTheProcess) {
  EXPECT_EQ(vpid_key("process"), "vpid");
  EXPECT_EQ(vpid_key("client_process"), "client_vpid");
}

}  // namespace
}  // namespace tracing
