// SPDX-License-Identifier: Apache-2.0
// Commands that describe launch files without running them: check, print, graph, schema, dry runs as scripts,
// completion.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::StartsWith;
using Json = nlohmann::json;

class WithoutRunning : public testing::Test {
 protected:
  CommandResult launch(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), LAUNCH_PROGRAM);
    return run_command(Command{arguments, {}, sandbox_.directory()});
  }

  std::string file(const std::string& name, const std::string& text) {
    const auto path = sandbox_.directory() / name;
    write_file(path, text);
    return path.string();
  }

  // How the launcher, which runs in the folder of the file, names it.
  static std::string shown(const std::string& path) { return std::filesystem::path(path).filename().string(); }

  Sandbox sandbox_;
};

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
            "launch check: error: no finding has the id 'LF0511'\n      = help: did you mean 'LF0501'?\n"
            "      = help: see 'launch check --help'\n");
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

TEST_F(WithoutRunning, PrintShowsTheTreeWithIncludedFiles) {
  const std::string inner =
      file("inner.launch.yaml", "launch:\n  - node: {pkg: p, exec: e, param: [{name: n, value: [1, 2]}]}\n");
  const std::string outer =
      file("outer.launch.xml",
           "<launch><group><include file=\"$(dirname)/inner.launch.yaml\"/></group><shutdown/></launch>\n");
  const CommandResult result = launch({"--print", outer});
  EXPECT_EQ(result.out, outer +
                            "\n"
                            "├── group\n"
                            "│   └── include file=\"$(dirname)/inner.launch.yaml\"\n"
                            "│       └── " +
                            inner +
                            "\n"
                            "│           └── node pkg=\"p\" exec=\"e\"\n"
                            "│               └── param name=\"n\" value=\"[1, 2]\"\n"
                            "└── shutdown\n");
  EXPECT_EQ(
      launch({"--print", "--show-args", outer}).err,
      "launch: error: --dry-run, --show-args and --print exclude each other\n      = help: see 'launch --help'\n");
}

TEST_F(WithoutRunning, SeveralFilesAreOneLaunch) {
  const std::string first = file("first.launch.xml", "<launch><let name=\"x\" value=\"1\"/></launch>\n");
  const std::string second = file("second.launch.yaml", "launch:\n  - log: {message: \"x is $(var x)\"}\n");
  const CommandResult result = launch({first, second});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("x is 1"));
  EXPECT_EQ(launch({first, "nowhere.launch.xml"}).err,
            "launch: error: malformed launch argument 'nowhere.launch.xml', expected format '<name>:=<value>'\n"
            "      = help: nor is it a further launch file: no such file\n");
}

TEST_F(WithoutRunning, StandardInputIsALaunchFile) {
  const std::string command =
      "echo '<launch><log message=\"in $(dirname)\"/><log mesage=\"\"/></launch>' | '" LAUNCH_PROGRAM "' --dry-run -";
  const CommandResult result = run_command(Command{{"/bin/sh", "-c", command}, {}, sandbox_.directory()});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, StartsWith("standard input:1:44: error: unexpected attribute 'mesage' in 'log'\n"));
}

TEST_F(WithoutRunning, DryRunAsAScriptRunsTheProcesses) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <set_env name="GREETING" value="it's"/>
  <unset_env name="UNWANTED"/>
  <executable cmd="/bin/sh -c 'echo $0 $GREETING ${UNWANTED-gone}; pwd' &quot;two words&quot;" cwd="/"/>
  <executable cmd="echo \$((1 + 1))" shell="true"/>
</launch>
)xml");
  CommandResult script = run_command(Command{{LAUNCH_PROGRAM, "--dry-run=shell", path}, {{"UNWANTED", "there"}}});
  EXPECT_EQ(script.exit_code, 0) << script.err;
  const std::string saved = file("run.sh", script.out);
  const CommandResult result = run_command(Command{{"/bin/sh", saved}, {{"UNWANTED", "there"}}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("two words it's gone\n"));
  EXPECT_THAT(result.out, HasSubstr("/\n"));
  EXPECT_THAT(result.out, HasSubstr("2\n"));  // they run at the same time, so the order is open
}

TEST_F(WithoutRunning, DryRunAsAScriptWritesParameterFiles) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <node pkg="demo_nodes" exec="talker" launch-prefix="/bin/echo"><param name="rate" value="20"/></node>
</launch>
)xml");
  const CommandResult script = launch({"--dry-run=shell", path});
  EXPECT_THAT(script.out, HasSubstr("rate: 20\n"));
  EXPECT_THAT(script.out, HasSubstr("trap 'rm -rf \"$parameters\"' EXIT\n"));
  const CommandResult result = run_command(Command{{"/bin/sh", file("run.sh", script.out)}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("--params-file"));
}

TEST_F(WithoutRunning, GraphHasNodesFilesNamespacesAndRemaps) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <node pkg="demo_nodes" exec="talker" name="mouth" namespace="/head"><remap from="chatter" to="/words"/></node>
  <executable cmd="sleep 1" name="nap"/>
</launch>
)xml");
  const CommandResult result = launch({"graph", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "digraph launch {\n"
            "  rankdir=LR;\n"
            "  node [fontname=\"sans-serif\"];\n"
            "  edge [fontname=\"sans-serif\"];\n"
            "  \"file " +
                path +
                "\" [shape=note, color=gray, label=\"a.launch.xml\"];\n"
                "  subgraph cluster_0 {\n"
                "  label=\"/head\";\n"
                "  \"/head/mouth\" [label=\"/head/mouth\\ndemo_nodes talker\"];\n"
                "  }\n"
                "  \"process 0\" [shape=box, label=\"nap\"];\n"
                "  \"topic /words\" [shape=plaintext, label=\"/words\"];\n"
                "  \"file " +
                path +
                "\" -> \"/head/mouth\" [color=gray];\n"
                "  \"/head/mouth\" -> \"topic /words\" [dir=none, color=blue, label=\"chatter\"];\n"
                "  \"file " +
                path +
                "\" -> \"process 0\" [color=gray];\n"
                "}\n");
}

TEST_F(WithoutRunning, GraphResolvesNamesAndShowsWhatWaitsAndWhatHandlersStart) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <node pkg="demo_nodes" exec="talker" name="mouth" namespace="left"><remap from="chatter" to="said"/></node>
  <node pkg="demo_nodes" exec="talker" name="mouth" namespace="right">
    <remap from="chatter" to="said"/><remap from="own" to="~/private"/><depends_on process="nap" condition="exited"/>
  </node>
  <node pkg="demo_nodes" exec="listener"/>
  <executable cmd="sleep 1" name="nap"/>
  <on_process_exit process="nap" exit_code="0"><executable cmd="true" name="later"/></on_process_exit>
</launch>
)xml");
  const CommandResult result = launch({"graph", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string from_file = "  \"file " + path + "\" -> ";
  EXPECT_EQ(result.out.substr(result.out.find("  subgraph")),
            "  subgraph cluster_0 {\n"
            "  label=\"/left\";\n"
            "  \"/left/mouth\" [label=\"/left/mouth\\ndemo_nodes talker\"];\n"
            "  }\n"
            "  subgraph cluster_1 {\n"
            "  label=\"/right\";\n"
            "  \"/right/mouth\" [label=\"/right/mouth\\ndemo_nodes talker\"];\n"
            "  }\n"
            "  \"process 0\" [shape=box, label=\"nap\"];\n"
            "  \"process 1\" [shape=box, label=\"later\"];\n"
            "  \"handler 0\" [shape=cds, color=orange, label=\"on_process_exit of 'nap' with exit code 0\"];\n"
            "  \"topic /left/said\" [shape=plaintext, label=\"/left/said\"];\n"
            "  \"topic /right/mouth/private\" [shape=plaintext, label=\"/right/mouth/private\"];\n"
            "  \"topic /right/said\" [shape=plaintext, label=\"/right/said\"];\n" +
                from_file + "\"/left/mouth\" [color=gray];\n" +
                "  \"/left/mouth\" -> \"topic /left/said\" [dir=none, color=blue, label=\"chatter\"];\n" + from_file +
                "\"/right/mouth\" [color=gray];\n" +
                "  \"/right/mouth\" -> \"topic /right/said\" [dir=none, color=blue, label=\"chatter\"];\n" +
                "  \"/right/mouth\" -> \"topic /right/mouth/private\" [dir=none, color=blue, label=\"own\"];\n" +
                from_file + "\"/listener\" [color=gray];\n" + from_file + "\"process 0\" [color=gray];\n" +
                "  \"/right/mouth\" -> \"process 0\" [style=dashed, label=\"waits until 'nap' has exited with exit "
                "code 0\"];\n" +
                from_file + "\"handler 0\" [color=gray];\n" + "  \"process 0\" -> \"handler 0\" [color=orange];\n" +
                from_file + "\"process 1\" [color=gray];\n" +
                "  \"handler 0\" -> \"process 1\" [color=orange, label=\"starts\"];\n"
                "}\n");
  EXPECT_THAT(result.out,
              HasSubstr("  \"/listener\" [label=\"/listener\\ndemo_nodes listener\\nnamed by the program\"]"));
}

TEST_F(WithoutRunning, GraphSaysWhatHandlersDoAndNamesContainersOfOthers) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <executable cmd="sleep 1" name="nap"/>
  <on_process_exit process="nap"><restart process="nap"/><shutdown/></on_process_exit>
  <load_composable_node target="/box/c"><composable_node pkg="p" plugin="p::A" name="part"/></load_composable_node>
</launch>
)xml");
  const CommandResult result = launch({"graph", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("label=\"on_process_exit of 'nap' with exit code any\\nends the launch\"];\n"));
  EXPECT_THAT(result.out, HasSubstr("  \"handler 0\" -> \"process 0\" [color=orange, label=\"restarts\"];\n"));
  EXPECT_THAT(result.out, HasSubstr("  label=\"/box\";\n  \"/box/c\" [label=\"/box/c\\nnot started here\"];\n"));
  const std::string picture = launch({"graph", "--format", "svg", path}).out;
  for (const char* const text : {">not started here<", ">loads<", ">restarts<", ">ends the launch<"}) {
    EXPECT_THAT(picture, HasSubstr(text));
  }
}

TEST_F(WithoutRunning, GraphOfAnEventHandlerOfPythonIsOneBox) {
  const std::string path = file("a.launch.py", R"py(from launch import EventHandler, LaunchDescription
from launch.actions import LogInfo, RegisterEventHandler

def generate_launch_description():
    return LaunchDescription([
        RegisterEventHandler(EventHandler(matcher=lambda event: False, entities=[LogInfo(msg='x')]))])
)py");
  const CommandResult result = launch({"graph", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("  \"handler 0\" [shape=cds, color=orange, label=\"event handler in line 6\\n"));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("handler 1")));
}

TEST_F(WithoutRunning, GraphIsAPictureToo) {
  const std::string inner = file("inner.launch.xml",
                                 "<launch><node pkg=\"demo_nodes\" exec=\"talker\" name=\"mouth\" namespace=\"head\">"
                                 "<remap from=\"chatter\" to=\"/a&lt;b\"/></node></launch>\n");
  const std::string path = file("a.launch.xml",
                                "<launch><executable cmd=\"sleep 1\"/><include file=\"$(dirname)/inner.launch.xml\"/>"
                                "<node_container pkg=\"rclcpp_components\" exec=\"component_container\" name=\"c\" "
                                "namespace=\"\"><composable_node pkg=\"p\" plugin=\"p::A\" name=\"part\"/>"
                                "</node_container></launch>\n");
  const CommandResult result = launch({"graph", "--format", "svg", "-o", "a.svg", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  const std::string picture = read_file(sandbox_.directory() / "a.svg");
  for (const char* const text :
       {">a.launch.xml<", ">inner.launch.xml<", ">/head<", ">/head/mouth<", ">demo_nodes talker<", ">/a&lt;b<",
        ">chatter<", ">sleep<", ">/c<", ">/part<", ">p::A in /c<", "class=\"loads\"", "class=\"remaps\""}) {
    EXPECT_THAT(picture, HasSubstr(text));
  }
  const CommandResult valid = run_command(Command{{"xmllint", "--noout", "a.svg"}, {}, sandbox_.directory()});
  EXPECT_EQ(valid.exit_code, 0) << valid.err;
}

TEST_F(WithoutRunning, SchemasAcceptTheExamplesAndRefuseErrors) {
  const std::string xsd = file("launch.xsd", launch({"schema", "xsd"}).out);
  const std::string wrong = file("wrong.launch.xml", "<launch><node pkg=\"p\" exce=\"e\"/></launch>\n");
  const CommandResult refused = run_command(Command{{"xmllint", "--noout", "--schema", xsd, wrong}});
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_THAT(refused.err, HasSubstr("The attribute 'exce' is not allowed"));

  // One process for all files: to load the schema takes most of the time.
  const std::string json = file("launch.json", launch({"schema", "json"}).out);
  const std::string validate = file("validate.py",
                                    "import json, sys, yaml, jsonschema\n"
                                    "schema = json.load(open(sys.argv[1]))\n"
                                    "jsonschema.Draft7Validator.check_schema(schema)\n"
                                    "validator = jsonschema.Draft7Validator(schema)\n"
                                    "refused = [f'{path}: {error}' for path in sys.argv[2:]\n"
                                    "           for error in validator.iter_errors(yaml.safe_load(open(path)))]\n"
                                    "sys.exit('\\n'.join(refused) or 0)\n");
  const std::string wrong_yaml = file("wrong.launch.yaml", "launch:\n  - node: {pkg: p, exce: e}\n");
  const CommandResult refused_yaml = run_command(Command{{"/usr/bin/python3", validate, json, wrong_yaml}});
  EXPECT_EQ(refused_yaml.exit_code, 1);
  EXPECT_THAT(refused_yaml.err, HasSubstr("'exce' was unexpected"));

  Command xml{{"xmllint", "--noout", "--schema", xsd}};
  Command yaml{{"/usr/bin/python3", validate, json}};
  for (const auto& entry : std::filesystem::directory_iterator(EXAMPLES_DIRECTORY)) {
    const std::string path = entry.path().string();
    if (path.ends_with(".launch.xml")) {
      xml.argv.push_back(path);
    }
    if (path.ends_with(".launch.yaml")) {
      yaml.argv.push_back(path);
    }
  }
  for (const Command& all : {xml, yaml}) {
    EXPECT_GT(all.argv.size(), 20u);
    const CommandResult result = run_command(all);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
}

TEST_F(WithoutRunning, SchemasOfTheDocumentationAreUpToDate) {
  EXPECT_EQ(launch({"schema", "xsd"}).out, read_file(DOCS_DIRECTORY "/schema/launch.xsd"))
      << "./dev launch schema xsd > docs/schema/launch.xsd";
  EXPECT_EQ(launch({"schema", "json"}).out, read_file(DOCS_DIRECTORY "/schema/launch.schema.json"))
      << "./dev launch schema json > docs/schema/launch.schema.json";
}

TEST_F(WithoutRunning, CompletionKnowsCommandsPackagesFilesAndArguments) {
  EXPECT_EQ(launch({"complete", "che"}).out, "check\n");
  EXPECT_THAT(launch({"complete", ""}).out, HasSubstr("demo_nodes\n"));
  EXPECT_THAT(launch({"complete", "launch_examples", "01"}).out, "01_ping_pong.launch.xml\n01_ping_pong.launch.yaml\n");
  EXPECT_EQ(launch({"complete", "launch_examples", "01_ping_pong.launch.xml", ""}).out, "count:=\nperiod_ms:=\n");
  EXPECT_EQ(launch({"complete", "check", "launch_examples", "01_ping_pong.launch.xml", "c"}).out, "count:=\n");
  EXPECT_EQ(launch({"complete", "trace", "re"}).out, "read\nrecord_snapshot\nresume\n");
  EXPECT_EQ(launch({"complete", "trace", "start", "x", "--subbuffer-size"}).out,
            "--subbuffer-size-kernel\n--subbuffer-size-ust\n");
  EXPECT_EQ(launch({"complete", "trace", "stop", "--f"}).out, "--fail-on-loss\n");
  EXPECT_EQ(launch({"complete", "trace", "start", "x", "-u", "ros2:rcl_i", "ros2:rcl_n"}).out, "ros2:rcl_node_init\n");
  EXPECT_EQ(launch({"complete", "trace", "-c", "vt"}).out, "vtid\n");
  EXPECT_EQ(launch({"complete", "trace", "stop", ""}).out, "") << "no session daemon is started to ask it";
  EXPECT_EQ(launch({"complete", "no_such_package", ""}).out, "");
  const std::string path =
      file("a.launch.xml",
           "<launch><arg name=\"mode\" default=\"a\"><choice value=\"a\"/><choice value=\"b\"/></arg></launch>\n");
  EXPECT_EQ(launch({"complete", path, "mode:="}).out, "mode:=a\nmode:=b\n");
}

TEST_F(WithoutRunning, BashCompletesArguments) {
  const std::string script =
      file("complete.bash", "launch() { '" LAUNCH_PROGRAM
                            "' \"$@\"; }\n"
                            "source '" COMPLETION_SCRIPT
                            "'\n"
                            "COMP_LINE='launch launch_examples 01_ping_pong.launch.xml count:='\n"
                            "COMP_LINE=\"${COMP_LINE%:=}\"; COMP_POINT=${#COMP_LINE}; _launch\n"
                            "echo \"${COMPREPLY[@]}\"\n"
                            "COMP_LINE='launch launch_examples 0'; COMP_POINT=${#COMP_LINE}; _launch\n"
                            "echo \"${#COMPREPLY[@]} ${COMPREPLY[0]}\"\n");
  const CommandResult result = run_command(Command{{"/bin/bash", script}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("count:=\n"));
  EXPECT_THAT(result.out, HasSubstr(" 01_ping_pong.launch.xml\n"));
}

}  // namespace
