// SPDX-License-Identifier: Apache-2.0
// Python launch files with errors, each with its complete error text: tests/golden/python/FILE and FILE.expected.
// LAUNCH_UPDATE_GOLDEN=1 writes the expected texts anew; read them before committing.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "launcher/python/interpreter/python_module.hpp"
#include "tests/unit/python/python_plan.hpp"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(PythonErrors, AreExplainedAtTheirPlace) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(GOLDEN_FILES "/python")) {
    if (entry.path().extension() == ".py") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 30U);
  for (const fs::path& path : files) {
    const fs::path expected = path.string() + ".expected";
    std::string found = test_support::plan_python(read(path), {.path = path.filename().string()}).error + "\n";
    // The place of the packages must not be in the expected text.
    const std::string& own_prefix = test_support::stand_in_prefix();
    if (const std::size_t prefix = found.find(own_prefix); prefix != std::string::npos) {
      found.replace(prefix, own_prefix.size(), "PREFIX");
    }
    if (std::getenv("LAUNCH_UPDATE_GOLDEN") != nullptr) {
      std::ofstream(expected, std::ios::binary) << found;
    }
    EXPECT_EQ(found, read(expected)) << path;
    EXPECT_THAT(found, Not(HasSubstr("Traceback")));
  }
}

TEST(PythonErrors, CarryTheTracebackWhenAskedTo) {
  launch::show_python_tracebacks();
  const std::string error = test_support::plan_items("        OpaqueFunction(function=lambda context: 1 / 0),").error;
  EXPECT_THAT(error, HasSubstr("error: ZeroDivisionError: division by zero"));
  EXPECT_THAT(error, HasSubstr("Traceback (most recent call last):"));
}

TEST(PythonErrors, StartNothing) {
  const auto planned = test_support::plan_items(
      "        ExecuteProcess(cmd=['true']),\n        LogInfo(msg=LaunchConfiguration('missing')),");
  EXPECT_THAT(planned.error, HasSubstr("launch configuration 'missing' does not exist"));
  EXPECT_TRUE(planned.plan.processes.empty());
}

}  // namespace
