// SPDX-License-Identifier: Apache-2.0
// eval, command, file-content, anon, param, for-var, index: substitutions that look beyond the text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "launcher/python/interpreter/python_module.hpp"
#include "tests/unit/substitution/template_test.hpp"

namespace launch {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

// Before the first expression of any test.
const bool module_is_chosen = [] {
  use_python_module(PYTHON_MODULE);
  return true;
}();

#define NEEDS_PYTHON()                                                                       \
  if (!std::filesystem::exists(PYTHON_MODULE)) {                                             \
    GTEST_SKIP() << "skipped, because this build has no Python (python3-dev, pybind11-dev)"; \
  }

Scope scope_with_path() {
  Scope scope = test_scope();
  scope.environment["PATH"] = "/usr/bin:/bin";
  return scope;
}

std::string perform_in(Scope scope, const std::string& text) {
  return parse_template(located(text)).perform(scope);
}

TEST(Eval, PrintsValuesAsPythonDoes) {
  NEEDS_PYTHON();
  EXPECT_EQ(perform("$(eval '1 + 2')"), "3");
  EXPECT_EQ(perform("$(eval 'sqrt(16)')"), "4.0");
  EXPECT_EQ(perform("$(eval 'math.pi > 3')"), "True");
  EXPECT_EQ(perform("$(eval '$(var x) > 5')"), "True");
  EXPECT_EQ(perform("$(if $(eval '$(var x) > 5') big small)"), "big");
  EXPECT_EQ(perform(R"($(eval '"a/b".split("/")[0]'))"), "a");
  EXPECT_EQ(perform("$(eval '[n * n for n in range(3\\)]')"), "[0, 1, 4]");
}

TEST(Eval, BlanksAtTheFrontDontMatter) {
  NEEDS_PYTHON();
  EXPECT_EQ(perform("$(eval ' 1 + 2 ')"), "3");
}

TEST(Eval, ListedModulesReplaceMath) {
  NEEDS_PYTHON();
  EXPECT_EQ(perform(R"($(eval 'os.path.basename("/a/b")' 'os, sys'))"), "b");
  EXPECT_THAT(perform_error("$(eval 'sqrt(4)' 'os')"), HasSubstr("NameError: name 'sqrt' is not defined"));
}

TEST(Eval, ErrorsAreOneLineOfPythonWithARemedy) {
  NEEDS_PYTHON();
  EXPECT_EQ(
      perform_error("$(eval '$(var true) == 1')"),
      "t:1:1: error: failed to evaluate the Python expression 'true == 1': NameError: name 'true' is not defined\n"
      "    1 | $(eval '$(var true) == 1')\n"
      "      | ^~~~~~~~~~~~~~~~~~~~~~~~~~\n"
      "      = help: Python writes booleans True and False; compare the text: \"$(var x)\" == \"true\"\n");
  EXPECT_THAT(perform_error("$(eval '1 +')"), HasSubstr("SyntaxError: invalid syntax"));
}

TEST(Command, GivesStandardOutputWithItsLineEnd) {
  EXPECT_EQ(perform_in(scope_with_path(), "$(command 'echo hi')"), "hi\n");
  EXPECT_EQ(perform_in(scope_with_path(), "$(command 'printf %s \"a b\"')"), "a b");
}

TEST(Command, LongOutputOfBothStreamsIsRead) {
  const std::string loud = "$(command 'sh -c \"seq 100000; seq 100000 >&2\"' ignore)";
  EXPECT_EQ(perform_in(scope_with_path(), loud).size(), 588895U);
}

TEST(Command, StandardErrorIsWhatItsSecondArgumentSays) {
  const auto with = [](const std::string& policy) {
    return "$(command 'sh -c \"echo out; echo err >&2\"'" + policy + ")";
  };
  EXPECT_THAT(perform_error(with(""), scope_with_path()), HasSubstr("it wrote to standard error"));
  EXPECT_EQ(perform_in(scope_with_path(), with(" ignore")), "out\n");
  EXPECT_EQ(perform_in(scope_with_path(), with(" capture")), "out\nerr\n");
  std::string warned;
  Scope scope = scope_with_path();
  scope.warn = [&](const SourceRange&, const std::string& text) { warned = text; };
  EXPECT_EQ(perform_in(scope, with(" warn")), "out\n");
  EXPECT_THAT(warned, HasSubstr("wrote to standard error: err"));
}

TEST(Command, FailuresSayWhatHappened) {
  EXPECT_EQ(perform_error("$(command 'sh -c \"echo why >&2; exit 3\"')", scope_with_path()),
            "t:1:1: error: executing command 'sh -c \"echo why >&2; exit 3\"' failed: exit code 3\n"
            "    1 | $(command 'sh -c \"echo why >&2; exit 3\"')\n"
            "      | ^~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\n"
            "      = help: it wrote: why\n");
  EXPECT_THAT(perform_error("$(command no_such_program)", scope_with_path()),
              HasSubstr("'no_such_program' was not found"));
  EXPECT_THAT(perform_error("$(command 'echo hi' shout)", scope_with_path()),
              HasSubstr("expected fail, warn, ignore or capture"));
}

TEST(FileContent, IsUnchanged) {
  const auto path = std::filesystem::path(testing::TempDir()) / ("file_content_" + std::to_string(::getpid()));
  std::ofstream(path) << "$(var x)\n";
  EXPECT_EQ(perform("$(file-content " + path.string() + ")"), "$(var x)\n");
  std::filesystem::remove(path);
  EXPECT_THAT(perform_error("$(file-content /nowhere)"), HasSubstr("file not found: '/nowhere'"));
}

TEST(Anon, IsTheSameWithinAScopeAndAValidName) {
  Scope scope = test_scope();
  const Template anon = parse_template(located("$(anon node.a)"));
  const std::string name = anon.perform(scope);
  EXPECT_THAT(name, MatchesRegex("node_a_[A-Za-z0-9_]+"));
  EXPECT_EQ(anon.perform(scope), name);
  EXPECT_NE(perform("$(anon node.a)"), name);
}

TEST(Param, IsTheLastValueAsPythonPrintsIt) {
  Scope scope = test_scope();
  scope.global_parameters = {NamedParameter{"p", ParameterScalar(std::int64_t{1})},
                             NamedParameter{"p", ParameterScalar(true)},
                             NamedParameter{"l", std::vector<ParameterScalar>{1.0, 2.5}}};
  EXPECT_EQ(perform_in(scope, "$(param p)"), "True");
  EXPECT_EQ(perform_in(scope, "$(param l)"), "(1.0, 2.5)");
  EXPECT_EQ(perform_in(scope, "$(param q none)"), "none");
  EXPECT_THAT(perform_error("$(param q)", scope), HasSubstr("parameter 'q' does not exist"));
}

TEST(LoopVariables, AreReadFromTheScope) {
  Scope scope = test_scope();
  scope.loop_variables = {{"name", "a"}, {"i", "3"}};
  EXPECT_EQ(perform_in(scope, "$(for-var name) $(index i) $(for-var other none)"), "a 3 none");
  EXPECT_EQ(perform_error("$(index j)"),
            "t:1:1: error: loop index 'j' does not exist here\n"
            "    1 | $(index j)\n"
            "      | ^~~~~~~~~~\n"
            "      = help: it is set inside a 'for' only\n");
}

TEST(FindPkgShare, WarnsWhenTheDirectoryIsMissing) {
  const auto prefix = std::filesystem::path(testing::TempDir()) / ("share_" + std::to_string(::getpid()));
  std::filesystem::create_directories(prefix / "share/ament_index/resource_index/packages");
  std::ofstream(prefix / "share/ament_index/resource_index/packages/bare");
  Scope scope = test_scope();
  scope.environment["AMENT_PREFIX_PATH"] = prefix.string();
  std::string warned;
  scope.warn = [&](const SourceRange&, const std::string& text) { warned = text; };
  const std::string share = (prefix / "share/bare").string();
  EXPECT_EQ(perform_in(scope, "$(find-pkg-share bare)"), share);
  EXPECT_EQ(warned, "package 'bare' has no share directory: '" + share + "' does not exist");
  std::filesystem::remove_all(prefix);
}

}  // namespace
}  // namespace launch
