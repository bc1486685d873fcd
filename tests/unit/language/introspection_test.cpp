// SPDX-License-Identifier: Apache-2.0
// --show-args and the check for required arguments, over real files.
#include "launcher/language/introspection.hpp"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "actions/builtin_actions.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/visit/launch_plan.hpp"

namespace {

namespace fs = std::filesystem;
using namespace launch;
using testing::HasSubstr;

class LaunchFiles : public testing::Test {
 protected:
  LaunchFiles() {
    char pattern[] = "/tmp/launch-files-XXXXXX";
    directory_ = ::mkdtemp(pattern);
    scope_.packages = std::make_shared<PackageIndex>();
  }
  ~LaunchFiles() override { fs::remove_all(directory_); }

  std::string write(const std::string& name, const std::string& actions) {
    std::ofstream(directory_ / name) << "<launch>\n" << actions << "\n</launch>\n";
    return (directory_ / name).string();
  }

  std::string show(const std::string& path) {
    return show_arguments(find_arguments(*load_launch_description(path, registry_, scope_), registry_, scope_));
  }

  // The result of the visit of a file: "" or the error.
  std::string visit(const std::string& path) {
    LaunchContext context(registry_, {}, "", [](LogLevel, std::string_view, std::string_view) {});
    try {
      plan_launch(context, *load_launch_description(path, registry_, context.scope()));
    } catch (const LaunchError& error) {
      return error.what();
    }
    return "";
  }

  fs::path directory_;
  Registry registry_ = builtin_actions();
  Scope scope_;
};

TEST_F(LaunchFiles, ArgumentsAreShownAsRos2LaunchDoes) {
  const std::string path = write("main.launch.xml", R"xml(
    <arg name="mode" default="x$(env HOME)" description="operation mode"><choice value="a"/><choice value="b"/></arg>
    <group><arg name="plain"/></group>
    <timer period="1.0"><arg name="extra" default=""/></timer>
    <arg name="chosen" default="a" if="$(var plain)"><choice value="a"/></arg>
    <arg name="mode" default="second"/>)xml");
  EXPECT_EQ(show(path),
            "Arguments (pass arguments as '<name>:=<value>'):\n"
            "\n"
            "    'mode':\n"
            "        operation mode. Valid choices are: ['a', 'b']\n"
            "        (default: 'x' + EnvVar('HOME'))\n"
            "\n"
            "    'plain':\n"
            "        no description given\n"
            "\n"
            "    'extra':*\n"
            "        no description given\n"
            "        (default: '')\n"
            "\n"
            "    'chosen':*\n"
            "        One of: ['a']\n"
            "        (default: 'a')\n"
            "\n"
            "* argument(s) which are only used if specific conditions occur\n");
}

TEST_F(LaunchFiles, NoArgumentsAreSaid) {
  EXPECT_EQ(show(write("main.launch.xml", "<log message=\"x\"/>")), "No arguments.\n");
}

TEST_F(LaunchFiles, ArgumentsOfIncludedFilesAreShown) {
  write("child.launch.xml", "<arg name=\"inner\" default=\"1\"/>");
  EXPECT_THAT(show(write("main.launch.xml", "<include file=\"$(dirname)/child.launch.xml\"/>")), HasSubstr("'inner':"));
}

TEST_F(LaunchFiles, AnIncludeMustGiveRequiredArgumentsItself) {
  const std::string child = write("child.launch.xml", "<arg name=\"req\" description=\"what for\"/>");
  const std::string with_let =
      write("main.launch.xml", "<let name=\"req\" value=\"1\"/><include file=\"" + child + "\"/>");
  EXPECT_EQ(visit(with_let),
            with_let +
                ":2:29: error: included launch description missing required argument 'req' (description: 'what for'), "
                "given: []\n"
                "    2 | <let name=\"req\" value=\"1\"/><include file=\"" +
                child +
                "\"/>\n"
                "      |                             ^~~~~~~\n"
                "      = help: it is declared without a default at " +
                child + ":2:2; add an arg of that name to the include");
  EXPECT_EQ(
      visit(write("good.launch.xml", "<include file=\"" + child + "\"><arg name=\"req\" value=\"1\"/></include>")), "");
}

TEST_F(LaunchFiles, RequiredArgumentsOfNestedIncludesAreFoundBeforeAnythingIsVisited) {
  const std::string leaf = write("leaf.launch.xml", "<arg name=\"req\"/>");
  const std::string middle =
      write("middle.launch.xml", "<log message=\"$(var never)\"/><include file=\"" + leaf + "\"/>");
  EXPECT_THAT(visit(write("main.launch.xml", "<include file=\"" + middle + "\"/>")),
              HasSubstr("missing required argument 'req'"));
}

TEST_F(LaunchFiles, ConditionalRequiredArgumentsAreCheckedWhenVisited) {
  const std::string child = write("child.launch.xml", "<group if=\"$(var on)\"><arg name=\"req\"/></group>");
  const std::string main =
      write("main.launch.xml", "<include file=\"" + child + "\"><arg name=\"on\" value=\"false\"/></include>");
  EXPECT_EQ(visit(main), "");
}

TEST_F(LaunchFiles, IncludesAreNoScopeAndRestoreTheirDirectory) {
  write("child.launch.xml", "<arg name=\"a\" default=\"c\"/><let name=\"set\" value=\"by child\"/>");
  const std::string main = write("main.launch.xml", R"xml(
    <arg name="a" default="p"/>
    <include file="$(dirname)/child.launch.xml"/>
    <executable cmd="$(var a) $(var set) $(filename)"/>)xml");
  LaunchContext context(registry_, {}, "", [](LogLevel, std::string_view, std::string_view) {});
  const LaunchPlan plan = plan_launch(context, *load_launch_description(main, registry_, context.scope()));
  EXPECT_THAT(plan.processes.at(0).argv, testing::ElementsAre("p", "by child", main));
}

TEST_F(LaunchFiles, ErrorsInIncludedFilesShowTheChainOfIncludes) {
  const std::string leaf = write("leaf.launch.xml", "<nod/>");
  const std::string middle = write("middle.launch.xml", "<include file=\"$(dirname)/leaf.launch.xml\"/>");
  const std::string main = write("main.launch.xml", "<include file=\"$(dirname)/middle.launch.xml\"/>");
  const std::string error = visit(main);
  EXPECT_THAT(error, HasSubstr(leaf + ":2:2: error: unrecognized entity of the type 'nod'"));
  EXPECT_THAT(error, HasSubstr("= included from " + middle + ":2:16"));
  EXPECT_THAT(error, HasSubstr("= included from " + main + ":2:16"));
}

TEST_F(LaunchFiles, AFileThatIncludesItselfIsAnError) {
  const std::string main = write("main.launch.xml", "<include file=\"$(dirname)/main.launch.xml\"/>");
  const std::string error = visit(main);
  EXPECT_THAT(error, HasSubstr("includes are nested more than 200 deep"));
  EXPECT_THAT(error, testing::EndsWith("      = and from 192 more"));
}

}  // namespace
