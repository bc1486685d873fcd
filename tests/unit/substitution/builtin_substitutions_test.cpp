// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/unit/substitution/template_test.hpp"

namespace launch {
namespace {

TEST(Substitution, VarGivesConfigurationThenDefault) {
  EXPECT_EQ(perform("$(var x)"), "7");
  EXPECT_EQ(perform("$(var empty no)"), "") << "set to empty is set";
  EXPECT_EQ(perform("$(var y no)"), "no");
}

TEST(Substitution, VarNamesTheMissingConfigurationAndTheNearest) {
  EXPECT_EQ(perform_error("a $(var wich)"),
            "t:1:3: error: launch configuration 'wich' does not exist\n"
            "    1 | a $(var wich)\n"
            "      |   ^~~~~~~~~~~\n"
            "      = help: did you mean 'which'?\n");
  EXPECT_EQ(perform_error("$(var unheard_of)"),
            "t:1:1: error: launch configuration 'unheard_of' does not exist\n"
            "    1 | $(var unheard_of)\n"
            "      | ^~~~~~~~~~~~~~~~~\n"
            "      = help: declare it with 'arg', set it with 'let', or give a default: $(var unheard_of DEFAULT)\n");
}

TEST(Substitution, EnvReadsTheLaunchEnvironmentNotThatOfTheProcess) {
  EXPECT_EQ(perform("$(env HOME)"), "/home/me");
  EXPECT_EQ(perform("$(env EMPTY no)"), "") << "set to empty is set";
  EXPECT_EQ(perform("$(env PATH none)"), "none");
}

TEST(Substitution, EnvNamesTheMissingVariable) {
  EXPECT_EQ(perform_error("$(env E)"),
            "t:1:1: error: environment variable 'E' does not exist\n"
            "    1 | $(env E)\n"
            "      | ^~~~~~~~\n"
            "      = help: give a default, which may be empty: $(env E '')\n");
}

TEST(Substitution, DirnameAndFilenameAreAbsolute) {
  Scope scope = test_scope();
  scope.current_file = std::make_shared<const SourceFile>("sub/../a.launch.xml", "");
  const std::string here = std::filesystem::current_path().string();
  EXPECT_EQ(parse_template(located("$(dirname)")).perform(scope), here);
  EXPECT_EQ(parse_template(located("$(filename)")).perform(scope), here + "/a.launch.xml");
  scope.current_file = std::make_shared<const SourceFile>("/opt/x/b.launch.xml", "");
  EXPECT_EQ(parse_template(located("$(dirname)/c")).perform(scope), "/opt/x/c");
}

TEST(Substitution, DirnameNeedsAFile) {
  EXPECT_EQ(perform_error("$(dirname)"),
            "t:1:1: error: no launch file is being visited here\n"
            "    1 | $(dirname)\n"
            "      | ^~~~~~~~~~\n");
}

TEST(Substitution, LogDirHasTwoNames) {
  Scope scope = test_scope();
  scope.log_directory = "/tmp/log";
  EXPECT_EQ(parse_template(located("$(log_dir) $(launch_log_dir)")).perform(scope), "/tmp/log /tmp/log");
}

TEST(Substitution, BooleansPointAtTheOperandThatIsNone) {
  EXPECT_EQ(perform_error("$(and true $(var x))"),
            "t:1:12: error: '7' is not a boolean\n"
            "    1 | $(and true $(var x))\n"
            "      |            ^~~~~~~~\n"
            "      = help: expected true, false, yes, no, on, off, 1 or 0\n");
  EXPECT_NE(perform_error("$(or true maybe)"), "") << "both operands are evaluated";
}

TEST(Substitution, StringJoinPutsTheSeparatorBetween) {
  EXPECT_EQ(perform("$(string-join , a $(var x) '')"), "a,7,");
  EXPECT_EQ(perform("$(string-join '' a b)"), "ab");
}

TEST(Substitution, EqualsComparesEmptyTexts) {
  EXPECT_EQ(perform("$(equals $(var empty) '')"), "true");
  EXPECT_EQ(perform("$(equals '' a)"), "false");
  EXPECT_EQ(perform("$(not-equals $(var x) '7.0')"), "false");
}

TEST(Substitution, DescribesItselfAsShowArgsPrintsIt) {
  const auto describe = [](const std::string& text) { return parse_template(located(text)).describe(); };
  EXPECT_EQ(describe(""), "''");
  EXPECT_EQ(describe("x$(env HOME)"), "'x' + EnvVar('HOME')");
  EXPECT_EQ(describe("$(var $(var which)b 3)"), "LaunchConfig(LaunchConfig('which') + 'b')");
  EXPECT_EQ(describe("$(find-pkg-share demo)/a"), "FindPackageShare(pkg='demo') + '/a'");
  EXPECT_EQ(describe("$(find-pkg-prefix demo)"), "FindPackagePrefix(pkg='demo')");
  EXPECT_EQ(describe("$(exec-in-pkg talker demo)"), "ExecInPkg(pkg='demo', exec='talker')");
  EXPECT_EQ(describe("$(find-exec ls)"), "FindExec('ls')");
  EXPECT_EQ(describe("$(dirname)$(filename)$(log_dir)"), "ThisLaunchFileDir() + ThisLaunchFile() + LaunchLogDir()");
  EXPECT_EQ(describe("$(if true a)"), "IfElseSubstitution('true', 'a', '')");
  EXPECT_EQ(describe("$(all a b)"), "AllSubstitution('a', 'b')");
}

TEST(Substitution, EveryTypeIsCompleteAndNamedOnce) {
  std::vector<std::string> names;
  for (const SubstitutionType& type : substitution_types()) {
    names.push_back(type.name);
    EXPECT_EQ(type.usage.substr(0, 2 + type.name.size()), "$(" + type.name);
    EXPECT_FALSE(type.help.empty()) << type.name;
    EXPECT_TRUE(type.make != nullptr) << type.name;
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace launch
