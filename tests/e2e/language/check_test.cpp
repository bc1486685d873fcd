// SPDX-License-Identifier: Apache-2.0
// `launch check`: what it finds, and how it tells that.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/language/without_running.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using Json = nlohmann::json;

TEST_F(WithoutRunning, CheckFindsAllErrorsOfAVisit) {
  const std::string path = file("system.launch.xml", R"xml(<launch>
  <arg name="unread" default="1"/>
  <node pkg="demo_nodes" exec="talkr"/>
  <executable cmd="no_such_program"/>
  <node pkg="demo_nodes" exec="talker" name="a"><remap from="x" to="x"/></node>
  <node pkg="demo_nodes" exec="talker" name="a"><remap from="b:x" to="y"/></node>
  <group if="false"><log message="$(var missing)"/></group>
</launch>
)xml");
  const CommandResult result = launch({"check", path});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out,
            shown(path) +
                ":3:32: error: executable 'talkr' not found on the libexec directory '" BUILD_DIRECTORY
                "/prefix/lib/demo_nodes' [LF0302]\n"
                "    3 |   <node pkg=\"demo_nodes\" exec=\"talkr\"/>\n"
                "      |                                ^~~~~\n"
                "      = help: did you mean 'talker'?\n" +
                shown(path) +
                ":7:35: warning: launch configuration 'missing' does not exist [LF0201]\n"
                "    7 |   <group if=\"false\"><log message=\"$(var missing)\"/></group>\n"
                "      |                                   ^~~~~~~~~~~~~~\n"
                "      = help: declare it with 'arg', set it with 'let', or give a default: $(var missing DEFAULT); a "
                "condition leaves this out with the arguments given\n" +
                shown(path) +
                ":2:4: warning: argument 'unread' is never read [LF0501]\n"
                "    2 |   <arg name=\"unread\" default=\"1\"/>\n"
                "      |    ^~~\n" +
                shown(path) +
                ":6:4: warning: another node is named '/a' [LF0404]\n"
                "    6 |   <node pkg=\"demo_nodes\" exec=\"talker\" name=\"a\"><remap from=\"b:x\" to=\"y\"/></node>\n"
                "      |    ^~~~\n"
                "      = help: the first is at " +
                shown(path) + ":5:4\n" + shown(path) +
                ":4:4: error: program 'no_such_program' can't be run: No such file or directory [LF0302]\n"
                "    4 |   <executable cmd=\"no_such_program\"/>\n"
                "      |    ^~~~~~~~~~\n" +
                shown(path) +
                ":5:4: warning: remap 'x:=x' changes nothing [LF0403]\n"
                "    5 |   <node pkg=\"demo_nodes\" exec=\"talker\" name=\"a\"><remap from=\"x\" to=\"x\"/></node>\n"
                "      |    ^~~~\n" +
                shown(path) +
                ":6:4: warning: remap 'b:x:=y' matches nothing: this node is named 'a' [LF0403]\n"
                "    6 |   <node pkg=\"demo_nodes\" exec=\"talker\" name=\"a\"><remap from=\"b:x\" to=\"y\"/></node>\n"
                "      |    ^~~~\n"
                "1 file: 2 errors, 5 warnings\n");
}

TEST_F(WithoutRunning, CheckTellsAsJsonAndSarif) {
  const std::string inner = file("inner.launch.xml", "<launch>\n  <log mesage=\"x\"/>\n</launch>\n");
  const std::string outer = file("outer.launch.xml", "<launch><include file=\"inner.launch.xml\"/></launch>\n");
  const CommandResult json = launch({"check", "--format", "json", outer});
  EXPECT_EQ(json.exit_code, 1);
  const Json list = Json::parse(json.out);
  ASSERT_GE(list.size(), 1u) << json.out;
  EXPECT_EQ(list[0]["id"], "LF0101");
  EXPECT_EQ(list[0]["severity"], "error");
  EXPECT_EQ(list[0]["message"], "unexpected attribute 'mesage' in 'log'");
  EXPECT_EQ(list[0]["help"], "did you mean 'message'?");
  EXPECT_EQ(list[0]["file"], inner);
  EXPECT_EQ(list[0]["line"], 2);
  EXPECT_EQ(list[0]["column"], 8);
  EXPECT_EQ(list[0]["end_column"], 14);
  EXPECT_EQ(list[0]["included_from"], Json::array({outer + ":1:24"}));

  const CommandResult sarif = launch({"check", "--format", "sarif", outer});
  const Json log = Json::parse(sarif.out);
  EXPECT_EQ(log["version"], "2.1.0");
  const Json& first = log["runs"][0]["results"][0];
  EXPECT_EQ(first["ruleId"], "LF0101");
  EXPECT_EQ(log["runs"][0]["tool"]["driver"]["rules"][0]["id"], "LF0101");
  EXPECT_EQ(log["runs"][0]["tool"]["driver"]["rules"][0]["shortDescription"]["text"], "Unknown name");
  EXPECT_EQ(first["level"], "error");
  EXPECT_EQ(first["message"]["text"], "unexpected attribute 'mesage' in 'log' (did you mean 'message'?)");
  EXPECT_EQ(first["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "file://" + inner);
  EXPECT_EQ(first["locations"][0]["physicalLocation"]["region"]["startLine"], 2);
  EXPECT_EQ(first["relatedLocations"][0]["physicalLocation"]["artifactLocation"]["uri"], "file://" + outer);
}

TEST_F(WithoutRunning, CheckSaysWhatAFileNeedsToBeChecked) {
  const std::string path =
      file("a.launch.xml", "<launch><arg name=\"x\"/><log message=\"$(var x) $(var y)\"/></launch>\n");
  const CommandResult without = launch({"check", path});
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_EQ(without.out,
            shown(path) +
                ":1:10: warning: argument 'x' has no default, so what depends on it was not checked [LF0503]\n"
                "    1 | <launch><arg name=\"x\"/><log message=\"$(var x) $(var y)\"/></launch>\n"
                "      |          ^~~\n"
                "      = help: give x:=VALUE\n" +
                shown(path) +
                ":1:47: error: launch configuration 'y' does not exist [LF0201]\n"
                "    1 | <launch><arg name=\"x\"/><log message=\"$(var x) $(var y)\"/></launch>\n"
                "      |                                               ^~~~~~~~\n"
                "      = help: declare it with 'arg', set it with 'let', or give a default: $(var y DEFAULT)\n"
                "1 file: 1 error, 1 warning\n");
  const CommandResult with = launch({"check", path, "x:=1"});
  EXPECT_EQ(with.exit_code, 1);
  EXPECT_THAT(with.out, HasSubstr("launch configuration 'y' does not exist"));
}

TEST_F(WithoutRunning, StrictCheckRefusesExtensions) {
  const std::string path = file("a.launch.xml", "<launch><trace session-name=\"s\" fail-on-loss=\"true\"/></launch>\n");
  EXPECT_EQ(launch({"check", path}).out, "1 file: 0 errors, 0 warnings\n");
  const CommandResult strict = launch({"check", "--strict-ros2", path});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_EQ(strict.out, shown(path) +
                            ":1:33: error: attribute 'fail-on-loss' of <trace> is not known to ros2 launch [LF0107]\n"
                            "    1 | <launch><trace session-name=\"s\" fail-on-loss=\"true\"/></launch>\n"
                            "      |                                 ^~~~~~~~~~~~\n"
                            "1 file: 1 error, 0 warnings\n");
}

TEST_F(WithoutRunning, CheckOfWrongUse) {
  EXPECT_EQ(launch({"check"}).exit_code, 2);
  EXPECT_EQ(launch({"check", "x:=1"}).err,
            "launch check: error: no launch file given\n      = help: see 'launch check --help'\n");
  EXPECT_EQ(launch({"check", "nowhere.launch.xml"}).exit_code, 1);
  EXPECT_EQ(launch({"check", "--format", "html", "x"}).exit_code, 2);
}

TEST_F(WithoutRunning, CheckLeavesOutDisabledFindings) {
  const std::string path = file("a.launch.xml", "<launch><arg name=\"x\" default=\"1\"/></launch>\n");
  EXPECT_EQ(launch({"check", "--disable", "LF0501", path}).out, "1 file: 0 errors, 0 warnings\n");
  EXPECT_EQ(launch({"check", "--disable", "lf0501", "--disable", "LF0101", path}).out,
            "1 file: 0 errors, 0 warnings\n");
  const CommandResult wrong = launch({"check", "--disable", "LF0511", path});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_EQ(wrong.out, "");
  EXPECT_EQ(wrong.err,
            "launch check: error: no finding has the id 'LF0511'\n      = help: did you mean 'LF0211'?\n"
            "      = help: see 'launch check --help'\n");
}

TEST_F(WithoutRunning, CheckFindsAnArgumentThatOnlyAParameterFileReads) {
  file("p.yaml", "/**: {ros__parameters: {frame: $(var robot)/base}}\n");
  const auto check = [this](const std::string& attributes) {
    const std::string path =
        file("a.launch.xml",
             "<launch><arg name=\"robot\" default=\"r\"/><arg name=\"on\" default=\"false\"/>"
             "<node pkg=\"demo_nodes\" exec=\"talker\" if=\"$(var on)\"><param from=\"$(dirname)/p.yaml\" " +
                 attributes + "/></node></launch>\n");
    return launch({"check", path}).out;
  };
  EXPECT_EQ(check("allow_substs=\"true\""), "1 file: 0 errors, 0 warnings\n");
  EXPECT_THAT(check(""), testing::HasSubstr("argument 'robot' is never read [LF0501]"));
}

TEST_F(WithoutRunning, CheckTakesWarningsForErrors) {
  const std::string path = file("a.launch.xml", "<launch><arg name=\"x\" default=\"1\"/></launch>\n");
  EXPECT_EQ(launch({"check", path}).exit_code, 0);
  const CommandResult result = launch({"check", "--werror", path});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, shown(path) +
                            ":1:10: error: argument 'x' is never read [LF0501]\n"
                            "    1 | <launch><arg name=\"x\" default=\"1\"/></launch>\n"
                            "      |          ^~~\n"
                            "1 file: 1 error, 0 warnings\n");
}

TEST_F(WithoutRunning, AMissingFileHidesNoFindingOfTheOthers) {
  const std::string path = file("a.launch.xml",
                                "<launch>\n  <include file=\"/nowhere.launch.xml\"/>\n"
                                "  <log message=\"$(var y)\"/>\n</launch>\n");
  const CommandResult result = launch({"check", "nowhere.launch.xml", path, "there.launch.xml"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out,
            "error: launch file 'nowhere.launch.xml' does not exist [LF0001]\n"
            "      = help: a file of a package is named by two words: launch PACKAGE FILE\n"
            "error: launch file 'there.launch.xml' does not exist [LF0001]\n"
            "      = help: a file of a package is named by two words: launch PACKAGE FILE\n" +
                shown(path) +
                ":2:18: error: can't read launch file '/nowhere.launch.xml': No such file or directory [LF0001]\n"
                "    2 |   <include file=\"/nowhere.launch.xml\"/>\n"
                "      |                  ^~~~~~~~~~~~~~~~~~~\n" +
                shown(path) +
                ":3:17: error: launch configuration 'y' does not exist [LF0201]\n"
                "    3 |   <log message=\"$(var y)\"/>\n"
                "      |                 ^~~~~~~~\n"
                "      = help: declare it with 'arg', set it with 'let', or give a default: $(var y DEFAULT)\n"
                "1 file: 4 errors, 0 warnings\n");
  EXPECT_EQ(Json::parse(launch({"check", "--format", "json", "nowhere.launch.xml"}).out)[0]["message"],
            "launch file 'nowhere.launch.xml' does not exist");
}

TEST_F(WithoutRunning, CheckSummarisesManyFindingsOfAKind) {
  std::string text = "<launch>\n";
  for (int i = 0; i < 150; ++i) {
    text += "<log message=\"$(var y)\"/>\n";
  }
  const std::string path = file("a.launch.xml", text + "</launch>\n");
  const CommandResult result = launch({"check", path});
  EXPECT_THAT(result.out, HasSubstr(shown(path) + ":101:15: error"));
  EXPECT_THAT(result.out, testing::Not(HasSubstr(shown(path) + ":102:15: error")));
  EXPECT_THAT(result.out, testing::EndsWith("50 more of LF0201 (Nothing has this name), --format json shows all\n"
                                            "1 file: 150 errors, 0 warnings\n"));
  EXPECT_EQ(Json::parse(launch({"check", "--format", "json", path}).out).size(), 150u);
}

// In the environment of a user, who has none of the variables that the sandbox sets.
TEST_F(WithoutRunning, EveryExampleIsWithoutFindings) {
  for (const auto& entry : std::filesystem::directory_iterator(EXAMPLES_DIRECTORY)) {
    const std::string path = entry.path().string();
    if (path.ends_with(".launch.xml") || path.ends_with(".launch.yaml")) {
      const CommandResult result = run_command({"env", "-u", "ROS_HOME", "-u", "ROS_LOG_DIR", "-u", "ROS_TRACE_DIR",
                                                "-u", "ROS_DOMAIN_ID", LAUNCH_PROGRAM, "check", path});
      EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
      const bool has_argument = path.find("/13_") != std::string::npos;  // it must be given
      EXPECT_THAT(result.out, HasSubstr(has_argument ? "1 file: 0 errors, 1 warning" : "1 file: 0 errors, 0 warnings"))
          << path;
    }
  }
}

}  // namespace
