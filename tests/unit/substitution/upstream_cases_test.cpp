// SPDX-License-Identifier: Apache-2.0
// The cases of the reference implementation's own tests that concern substitutions.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "launcher/substitution/boolean.hpp"
#include "tests/unit/substitution/template_test.hpp"

namespace launch {
namespace {

using Json = nlohmann::json;

std::vector<Json> cases_of(const std::set<std::string>& kinds) {
  std::ifstream file(CORPUS "/upstream_cases.jsonl");
  std::vector<Json> cases;
  for (std::string line; std::getline(file, line);) {
    Json row = Json::parse(line);
    if (kinds.count(row["kind"].get<std::string>()) > 0) {
      cases.push_back(std::move(row));
    }
  }
  return cases;
}

// Upstream's tests use $(test X), which gives X. $(env X) of an unset variable with X as its default does the same.
std::string with_env_for_test(std::string text) {
  constexpr std::string_view kTest = "$(test ";
  for (std::size_t at = text.find(kTest); at != std::string::npos; at = text.find(kTest, at)) {
    text.replace(at, kTest.size(), "$(env UNSET ");
  }
  return text;
}

TEST(UpstreamCases, SubstitutionStringsParse) {
  const std::vector<Json> cases = cases_of({"parse_substitution", "parse_if_substitutions"});
  ASSERT_FALSE(cases.empty());
  Scope scope = test_scope();
  for (const Json& row : cases) {
    if (!row["launch_text"].is_string()) {
      continue;
    }
    const auto text = with_env_for_test(row["launch_text"]);
    SCOPED_TRACE(row["id"].get<std::string>() + ": " + text);
    if (row["expect"] == "error") {
      EXPECT_THROW(parse_template(located(text)).perform(scope), LaunchError);
      continue;
    }
    const Template parsed = parse_template(located(text));
    if (row.contains("value") && row["value"].is_array()) {
      std::string joined;
      for (const Json& part : row["value"]) {
        joined += part.get<std::string>();
      }
      EXPECT_EQ(parsed.perform(scope), joined);
      EXPECT_EQ(parsed.parts().size(), row["launch_text"].get<std::string>().empty() ? 0 : row["value"].size());
    }
  }
}

TEST(UpstreamCases, CommandLinesSplit) {
  const std::vector<Json> cases = cases_of({"parse_cmdline"});
  ASSERT_FALSE(cases.empty());
  Scope scope = test_scope();
  for (const Json& row : cases) {
    SCOPED_TRACE(row["id"].get<std::string>());
    std::vector<std::string> words;
    for (const Template& word : split_command_line(parse_template(located(with_env_for_test(row["launch_text"]))))) {
      words.push_back(word.perform(scope));
    }
    EXPECT_EQ(words, row["value"].get<std::vector<std::string>>());
  }
}

TEST(UpstreamCases, ConditionsAreEvaluated) {
  const std::vector<Json> cases = cases_of({"condition"});
  ASSERT_FALSE(cases.empty());
  for (const Json& row : cases) {
    const std::optional<bool> expected = row["expect"] == "ok" ? std::optional(row["value"].get<bool>()) : std::nullopt;
    EXPECT_EQ(condition_boolean(row["launch_text"].get<std::string>()), expected) << row["id"];
  }
}

// Rows like "and true not-condition-expression".
TEST(UpstreamCases, BooleanSubstitutionsAreEvaluated) {
  const std::vector<Json> cases = cases_of({"boolean", "if"});
  ASSERT_FALSE(cases.empty());
  for (const Json& row : cases) {
    auto text = row["launch_text"].get<std::string>();
    text = text.substr(0, text.find(" ("));
    text.erase(text.find_last_not_of(' ') + 1);
    SCOPED_TRACE(row["id"].get<std::string>() + ": " + text);
    if (row["expect"] == "ok") {
      EXPECT_EQ(perform("$(" + text + ")"), row["value"].get<std::string>());
    } else {
      EXPECT_THROW(perform("$(" + text + ")"), LaunchError);
    }
  }
}

// Rows like "equals(True, 'true')": Python values, which upstream turns into text first.
TEST(UpstreamCases, EqualityHoldsInBothOrders) {
  const std::vector<Json> cases = cases_of({"equals"});
  ASSERT_FALSE(cases.empty());
  constexpr std::string_view kCall = "equals(";
  const auto operand = [](std::string text) -> std::string {
    if (text == "None") {
      return "";
    }
    if (text == "10 + 1e-10") {
      return "10.0000000001";
    }
    if (text.rfind("float('", 0) == 0) {
      return text.substr(7, text.size() - 9);
    }
    const char first = text.front();
    return first == '\'' || first == '"' ? text.substr(1, text.size() - 2) : text;
  };
  for (const Json& row : cases) {
    const auto text = row["launch_text"].get<std::string>();
    SCOPED_TRACE(row["id"].get<std::string>() + ": " + text);
    const std::size_t comma = text.find(", ");
    ASSERT_NE(comma, std::string::npos);
    const std::string left = operand(text.substr(kCall.size(), comma - kCall.size()));
    const std::string right = operand(text.substr(comma + 2, text.size() - comma - 3));
    EXPECT_EQ(launch_equal(left, right), row["value"] == "true");
    EXPECT_EQ(launch_equal(right, left), row["value"] == "true");
  }
}

}  // namespace
}  // namespace launch
