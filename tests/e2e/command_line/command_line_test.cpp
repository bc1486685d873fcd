// SPDX-License-Identifier: Apache-2.0
// The command line of the launcher, and its messages for files that it can't read: exit code 1, the place, nothing
// started.
#include <gmock/gmock.h>

#include <ostream>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class CommandLine : public testing::Test {
 protected:
  CommandResult launch(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), LAUNCH_PROGRAM);
    return run_command(arguments);
  }

  Sandbox sandbox_;
};

TEST_F(CommandLine, HelpNamesTheOptionsAndTheOtherCommands) {
  const CommandResult result = launch({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* const part : {"--dry-run", "--show-args", "--timing", "launch trace", "launch report"}) {
    EXPECT_THAT(result.out, HasSubstr(part));
  }
  EXPECT_EQ(launch({"trace", "--help"}).exit_code, 0);
  EXPECT_EQ(launch({"report", "--help"}).exit_code, 0);
}

// Each library costs every command and every launch a part of a millisecond.
TEST_F(CommandLine, LoadsNoLibraryBeforeItIsNeeded) {
  const CommandResult result = run_command({"/usr/bin/env", "LD_TRACE_LOADED_OBJECTS=1", LAUNCH_PROGRAM});
  EXPECT_THAT(result.out, HasSubstr("libc.so"));
  for (const char* const library : {"liblttng", "libxml2", "libicu", "libpython", "libncurses"}) {
    EXPECT_THAT(result.out, Not(HasSubstr(library)));
  }
}

TEST_F(CommandLine, ReferencePageOfTheDocumentationIsUpToDate) {
  const CommandResult result = launch({"reference"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.out, read_file(DOCS_DIRECTORY "/launch_reference.md"))
      << "./dev launch reference > docs/launch_reference.md";
}

TEST_F(CommandLine, WrongUseIsExitCodeTwo) {
  EXPECT_EQ(launch({}).err, "launch: error: no launch file given\n      = help: see 'launch --help'\n");
  EXPECT_EQ(launch({}).exit_code, 2);
  EXPECT_EQ(launch({"file.xml", ":=1"}).err,
            "launch: error: malformed launch argument ':=1', expected format '<name>:=<value>'\n"
            "      = help: see 'launch --help'\n");
  EXPECT_EQ(launch({"--dry-run=xml", "file.xml"}).err,
            "launch: error: --dry-run=xml is unknown, expected text, json or shell\n"
            "      = help: see 'launch --help'\n");
  EXPECT_EQ(launch({"--no-such-option", "file.xml"}).exit_code, 2);
  EXPECT_EQ(launch({"check", "--werror"}).err,
            "launch check: error: no launch file given\n      = help: see 'launch check --help'\n");
}

TEST_F(CommandLine, MistypedOptionsAndCommandsAreSuggested) {
  const auto expect_error = [&](const std::vector<std::string>& arguments, const std::string& error) {
    const CommandResult result = launch(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.err, error);
  };
  expect_error({"--dryrun", "file.xml"},
               "launch: error: unknown option '--dryrun'\n      = help: did you mean '--dry-run'?\n"
               "      = help: see 'launch --help'\n");
  expect_error({"--frobnicate", "file.xml"},
               "launch: error: unknown option '--frobnicate'\n      = help: see 'launch --help'\n");
  expect_error({"check", "--formt=json", "file.xml"},
               "launch check: error: unknown option '--formt'\n      = help: did you mean '--format'?\n"
               "      = help: see 'launch check --help'\n");
  expect_error({"graph", "--otput", "x", "file.xml"},
               "launch graph: error: unknown option '--otput'\n      = help: did you mean '--output'?\n"
               "      = help: see 'launch graph --help'\n");
  expect_error({"report", "--jsn", "directory"},
               "launch report: error: unknown option '--jsn'\n      = help: did you mean '--json'?\n"
               "      = help: see 'launch report --help'\n");
  expect_error({"trace", "read", "--evnt", "x", "directory"},
               "launch trace read: error: unknown option '--evnt'\n      = help: did you mean '--event'?\n"
               "      = help: see 'launch trace read --help'\n");
  expect_error({"trace", "strat", "session"},
               "launch trace: error: unknown command 'strat'\n      = help: did you mean 'start'?\n"
               "      = help: see 'launch trace --help'\n");

  EXPECT_EQ(
      launch({"chek"}).err,
      "launch: error: launch file 'chek' does not exist\n      = help: did you mean the command 'launch check'?\n");
  EXPECT_THAT(launch({"chek", "system.launch.xml"}).err, HasSubstr("did you mean the command 'launch check'?"));
}

TEST_F(CommandLine, StandardInputMayBeAPythonFile) {
  const auto launch_text = [](const std::string& text) {
    return run_command({"sh", "-c", "printf '%s' \"$1\" | \"$0\" --dry-run=shell -", LAUNCH_PROGRAM, text});
  };
  const CommandResult python = launch_text(
      "from launch import LaunchDescription\n"
      "from launch.actions import ExecuteProcess\n\n"
      "def generate_launch_description():\n"
      "    return LaunchDescription([ExecuteProcess(cmd=['echo', 'from python'])])\n");
  EXPECT_EQ(python.exit_code, 0) << python.err;
  EXPECT_THAT(python.out, HasSubstr("echo 'from python'"));
  EXPECT_EQ(launch_text("import launch\n\nlaunch.LaunchDescriptio()\n").err,
            "standard input:3:1: error: this launcher's launch has no 'LaunchDescriptio'\n"
            "    3 | launch.LaunchDescriptio()\n"
            "      | ^~~~~~~~~~~~~~~~~~~~~~~\n"
            "      = help: did you mean 'LaunchDescription'?\n");
  EXPECT_THAT(launch_text("launch:\n- executable: {cmd: echo yaml}\n").out, HasSubstr("echo yaml"));
}

TEST_F(CommandLine, MissingFilesAndPackagesAreNamed) {
  const CommandResult file = launch({"nowhere.launch.xml"});
  EXPECT_EQ(file.exit_code, 1);
  EXPECT_THAT(file.err, StartsWith("launch: error: launch file 'nowhere.launch.xml' does not exist\n"));
  EXPECT_EQ(launch({EXAMPLES_DIRECTORY "/01_ping_pon.launch.xml"}).err,
            "launch: error: launch file '" EXAMPLES_DIRECTORY
            "/01_ping_pon.launch.xml' does not exist\n"
            "      = help: did you mean '" EXAMPLES_DIRECTORY "/01_ping_pong.launch.xml'?\n");
  const CommandResult directory = launch({EXAMPLES_DIRECTORY});
  EXPECT_EQ(directory.exit_code, 1);
  EXPECT_EQ(directory.err, "launch: error: '" EXAMPLES_DIRECTORY
                           "' is a directory, not a launch file\n"
                           "      = help: give one of its files\n");
  const CommandResult in_package = launch({"launch_examples", "01_ping_pon.launch.xml"});
  EXPECT_EQ(in_package.exit_code, 1);
  EXPECT_THAT(in_package.err, HasSubstr("file '01_ping_pon.launch.xml' was not found in the share directory of package "
                                        "'launch_examples'"));
  EXPECT_THAT(in_package.err, HasSubstr("did you mean '01_ping_pong.launch.xml'?"));
  EXPECT_EQ(launch({"--show-args", "launch_examples", "01_ping_pong.launch.xml"}).exit_code, 0);
}

TEST_F(CommandLine, ShowArgsIsEqualForBothFormats) {
  const CommandResult xml = launch({"--show-args", EXAMPLES_DIRECTORY "/01_ping_pong.launch.xml"});
  const CommandResult yaml = launch({"-s", EXAMPLES_DIRECTORY "/01_ping_pong.launch.yaml"});
  EXPECT_EQ(xml.exit_code, 0);
  EXPECT_EQ(xml.out,
            "Arguments (pass arguments as '<name>:=<value>'):\n"
            "\n"
            "    'count':\n"
            "        how many messages ping sends; 0: until it is stopped\n"
            "        (default: '10')\n"
            "\n"
            "    'period_ms':\n"
            "        milliseconds between two messages\n"
            "        (default: '100')\n");
  EXPECT_EQ(xml.out, yaml.out);
}

TEST_F(CommandLine, UnknownAndRepeatedArgumentsAreReported) {
  const auto file = sandbox_.directory() / "args.launch.xml";
  write_file(file, "<launch><arg name=\"rate\" default=\"1\"/><log message=\"$(var read '')\"/></launch>\n");
  const std::string warning =
      "launch: warning: launch argument 'rat' is unknown to the launch file\n"
      "      = help: did you mean 'rate'?\n"
      "launch: warning: launch argument 'rate' is given more than once\n"
      "      = help: the last one counts\n"
      "[launch.user]: \n";
  const CommandResult tolerant = launch({"--dry-run", file.string(), "rat:=2", "rate:=3", "rate:=4"});
  EXPECT_EQ(tolerant.exit_code, 0);
  EXPECT_EQ(tolerant.err, warning);
  const CommandResult strict = launch({"--dry-run", "--strict-args", file.string(), "rat:=2"});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_EQ(strict.err,
            "launch: error: launch argument 'rat' is unknown to the launch file\n"
            "      = help: did you mean 'rate'?\n");
  EXPECT_EQ(launch({"--dry-run", "--strict-args", file.string(), "rate:=2", "emulate_tty:=true", "read:=x"}).err,
            "[launch.user]: x\n");
}

TEST_F(CommandLine, DryRunOfAllProcessAttributes) {
  const auto file = sandbox_.directory() / "system.launch.xml";
  write_file(file, R"xml(<launch>
  <set_env name="A" value="it's"/>
  <unset_env name="GONE"/>
  <executable cmd="echo 'a b' $(env A)" cwd="/tmp" name="talker">
    <env name="B" value="2"/>
  </executable>
  <node exec="/bin/true" name="n" namespace="/ns">
    <param name="rate" value="10"/>
  </node>
</launch>
)xml");
  const Command text{.argv = {LAUNCH_PROGRAM, "--dry-run", file.string()}, .environment = {{"GONE", "1"}}};
  EXPECT_EQ(run_command(text).out, "talker (" + file.string() +
                                       ":4:4)\n"
                                       "  echo 'a b' 'it'\\''s'\n"
                                       "  cwd: /tmp\n"
                                       "  env: A='it'\\''s'\n"
                                       "  env: B=2\n"
                                       "  env: GONE removed\n"
                                       "\n"
                                       "true (" +
                                       file.string() +
                                       ":7:4)\n"
                                       "  /bin/true --ros-args -r __node:=n -r __ns:=/ns --params-file @params:0\n"
                                       "  env: A='it'\\''s'\n"
                                       "  env: GONE removed\n"
                                       "  @params:0:\n"
                                       "      /ns/n:\n"
                                       "        ros__parameters:\n"
                                       "          rate: 10\n"
                                       "\n"
                                       "2 processes, 0 traces; nothing was started\n");
  const Command json{.argv = {LAUNCH_PROGRAM, "--dry-run=json", file.string()}, .environment = {{"GONE", "1"}}};
  EXPECT_EQ(run_command(json).out, R"json({
  "version": 1,
  "outcome": "ok",
  "processes": [
    {
      "name": "talker",
      "argv": [
        "echo",
        "a b",
        "it's"
      ],
      "cwd": "/tmp",
      "env": {
        "A": "it's",
        "B": "2",
        "GONE": null
      },
      "shell": false,
      "source": {
        "file": ")json" + file.string() +
                                       R"json(",
        "line": 4
      }
    },
    {
      "name": "true",
      "argv": [
        "/bin/true",
        "--ros-args",
        "-r",
        "__node:=n",
        "-r",
        "__ns:=/ns",
        "--params-file",
        "@params:0"
      ],
      "cwd": null,
      "env": {
        "A": "it's",
        "GONE": null
      },
      "shell": false,
      "params": [
        {
          "/ns/n": {
            "ros__parameters": {
              "rate": 10
            }
          }
        }
      ],
      "source": {
        "file": ")json" + file.string() +
                                       R"json(",
        "line": 7
      },
      "node": {
        "package": null,
        "executable": "/bin/true",
        "name": "n",
        "namespace": "/ns"
      }
    }
  ],
  "composable": [],
  "traces": [],
  "logs": [],
  "python_includes": [],
  "includes": 0,
  "shutdown": false
}
)json");
}

struct Malformed {
  const char* name;
  const char* file;   // suffix decides the format
  const char* text;   // the second line would start a process if the file were accepted
  const char* error;  // after "FILE:"
};

void PrintTo(const Malformed& row, std::ostream* out) {
  *out << row.name;
}

class MalformedFiles : public CommandLine, public testing::WithParamInterface<Malformed> {};

TEST_P(MalformedFiles, AreErrorsAtTheirPlaceAndStartNothing) {
  const Malformed& malformed = GetParam();
  const auto file = sandbox_.directory() / malformed.file;
  const auto witness = sandbox_.directory() / "started";
  write_file(file, malformed.text);
  const CommandResult result =
      run_command(Command{.argv = {LAUNCH_PROGRAM, file.string(), "witness:=" + witness.string()}});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, StartsWith(file.string() + ":" + malformed.error)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("^"));
  EXPECT_FALSE(std::filesystem::exists(witness));
}

INSTANTIATE_TEST_SUITE_P(
    Ten, MalformedFiles,
    testing::Values(
        Malformed{"UnclosedTag", "a.launch.xml",
                  "<launch>\n<executable cmd='touch $(var witness)'/>\n<group>\n</launch>\n",
                  "3:1: error: <group> is never closed\n"},
        Malformed{"TwoRoots", "a.launch.xml",
                  "<launch>\n<executable cmd='touch $(var witness)'/>\n</launch>\n<launch/>\n", "4:"},
        Malformed{"WrongRoot", "a.launch.xml", "<lunch>\n<executable cmd='touch $(var witness)'/>\n</lunch>\n",
                  "1:2: error: "},
        Malformed{"DuplicateAttribute", "a.launch.xml",
                  "<launch>\n<executable cmd='touch $(var witness)'/>\n<log message='a' message='b'/>\n</launch>\n",
                  "3:18: error: "},
        Malformed{"UnknownXmlEntity", "a.launch.xml",
                  "<launch>\n<executable cmd='touch $(var witness)'/>\n<log message='&nope;'/>\n</launch>\n",
                  "3:15: error: "},
        Malformed{"UnknownTag", "a.launch.xml",
                  "<launch>\n<executable cmd='touch $(var witness)'/>\n<nodes/>\n</launch>\n",
                  "3:2: error: unrecognized entity of the type 'nodes'\n"},
        Malformed{"UnknownSubstitution", "a.launch.xml",
                  "<launch>\n<executable cmd='touch $(var witness)'/>\n<log message='$(vr x)'/>\n</launch>\n", "3:"},
        Malformed{"UnbalancedSubstitution", "a.launch.xml",
                  "<launch>\n<executable cmd='touch $(var witness)'/>\n<log message='$(var x'/>\n</launch>\n", "3:"},
        Malformed{"TabInYaml", "a.launch.yaml",
                  "launch:\n- executable: {cmd: touch $(var witness)}\n- log:\n\tmessage: x\n", "4:1: error: "},
        Malformed{
            "TwoKeysInAYamlAction", "a.launch.yaml",
            "launch:\n- executable: {cmd: touch $(var witness)}\n- log: {message: x}\n  let: {name: a, value: b}\n",
            "4:"},
        Malformed{"NullYamlAction", "a.launch.yaml",
                  "launch:\n- executable: {cmd: touch $(var witness)}\n- shutdown:\n", "3:"},
        Malformed{"WrongYamlType", "a.launch.yaml",
                  "launch:\n- executable: {cmd: touch $(var witness)}\n- arg: {name: a, default: 1}\n",
                  "3:27: error: attribute 'default' of 'arg' is expected to be of type str, got int\n"},
        Malformed{"UndefinedVariable", "a.launch.xml",
                  "<launch>\n<executable cmd='touch $(var witness)'/>\n<log message='$(var nothing)'/>\n</launch>\n",
                  "3:"}),
    [](const auto& row) { return std::string(row.param.name); });

}  // namespace
