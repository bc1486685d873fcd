// SPDX-License-Identifier: Apache-2.0
// Plans the faults of a test that a test of <fault> holds as text.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "actions/builtin_actions.hpp"
#include "launcher/visit/launch_plan.hpp"

namespace test_support {

struct PlannedFaults {
  launch::LaunchPlan plan;
  std::string error;  // what() of the error that ended the plan; "" for none

  const std::vector<launch::FaultRequest>& faults() const { return plan.tests.at(0).faults; }
};

// The text is an XML file, or a YAML file if it doesn't start with '<'. It has one test.
inline PlannedFaults plan_test_file(const std::string& text, const launch::TestVisits::FaultChoice& choice = {}) {
  static const launch::Registry registry = launch::builtin_actions();
  launch::LaunchContext context(registry, {{"PATH", "/usr/bin:/bin"}}, "", [](auto...) {});
  context.tests().take(0);
  context.tests().choose_faults(choice);
  const char* const path = text.starts_with('<') ? "/t.launch.xml" : "/t.launch.yaml";
  try {
    return {launch::plan_launch(
                context, *launch::parse_launch_description(std::make_shared<launch::SourceFile>(path, text), registry)),
            ""};
  } catch (const launch::LaunchError& error) {
    return {{}, error.what()};
  }
}

// The text is what stands in the test. `before` is one line, before the test; the faults begin in line 4.
inline PlannedFaults plan_faults(const std::string& faults, const launch::TestVisits::FaultChoice& choice = {},
                                 const std::string& before = "<executable cmd=\"p\"/>") {
  return plan_test_file(
      "<launch>\n" + before + "\n<test name=\"t\"><output text=\"a\"/>\n" + faults + "\n</test></launch>", choice);
}

inline PlannedFaults plan_faults(const std::string& faults, std::uint64_t seed) {
  return plan_faults(faults, launch::TestVisits::FaultChoice{seed, std::nullopt});
}

}  // namespace test_support
