// SPDX-License-Identifier: Apache-2.0
// The same launch file in XML, YAML and Python gives the same requests:
// tests/golden/triplets/NAME.launch.{xml,yaml,py}.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "actions/builtin_actions.hpp"
#include "launcher/plan/dry_run.hpp"
#include "launcher/python/interpreter/python_module.hpp"
#include "launcher/visit/launch_plan.hpp"
#include "tests/unit/python/python_plan.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<std::string> names() {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(GOLDEN_FILES "/triplets")) {
    if (entry.path().extension() == ".xml") {
      found.push_back(entry.path().stem().stem().string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

// Removes the only differences: places, and the names by which handlers and commands refer to processes. Python refers
// to the action.
json comparable(json value) {
  if (value.is_object()) {
    value.erase("source");
    for (const char* const key : {"event", "command", "until"}) {
      if (value.contains(key)) {
        value[key] = std::regex_replace(value[key].get<std::string>(), std::regex("'[^']*'"), "a process");
      }
    }
  }
  if (value.is_object() && value.contains("limits")) {
    for (auto& limit : value["limits"]) {
      limit = std::regex_replace(limit.get<std::string>(), std::regex(" \\([^()]*\\)$"), "");
    }
  }
  if (value.is_structured()) {
    for (auto& item : value) {
      item = comparable(item);
    }
  }
  return value;
}

json plan(const std::string& name, const std::string& suffix) {
  const launch::Registry registry = launch::builtin_actions();
  const launch::Environment environment = {{"HOME", "/home/user"}, {"PATH", "/usr/bin:/bin"}};
  launch::LaunchContext context(registry, environment, test_support::stand_in_prefix(), [](auto...) {});
  const auto description =
      launch::load_launch_description(GOLDEN_FILES "/triplets/" + name + suffix, registry, context.scope());
  return comparable(json::parse(launch::plan_as_json(launch::plan_launch(context, *description), environment)));
}

class Triplets : public testing::TestWithParam<std::string> {};

TEST_P(Triplets, AskForTheSame) {
  launch::use_python_module(PYTHON_MODULE);
  const json xml = plan(GetParam(), ".launch.xml");
  EXPECT_TRUE(!xml["processes"].empty() || !xml["logs"].empty()) << "the file asks for nothing";
  EXPECT_EQ(plan(GetParam(), ".launch.yaml"), xml);
  // There is no Python file where Python uses a function of its own.
  if (fs::exists(GOLDEN_FILES "/triplets/" + GetParam() + ".launch.py")) {
    EXPECT_EQ(plan(GetParam(), ".launch.py"), xml);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Triplets, testing::ValuesIn(names()), [](const auto& row) { return row.param; });

}  // namespace
