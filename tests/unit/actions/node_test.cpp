// SPDX-License-Identifier: Apache-2.0
// <node>: its argv, names, namespaces, remaps and parameter files.
#include <gmock/gmock.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/unit/actions/launch_text.hpp"

namespace {

namespace fs = std::filesystem;
using launch::ProcessSpec;
using test_support::plan_actions;
using test_support::Planned;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> argv_of(const std::string& xml, const test_support::PlanOptions& options = {}) {
  const Planned planned = plan_actions(xml, options);
  EXPECT_EQ(planned.error, "");
  EXPECT_EQ(planned.plan.processes.size(), 1U);
  return planned.plan.processes.empty() ? std::vector<std::string>() : planned.plan.processes.front().argv;
}

TEST(Node, RosArgumentsAreAlwaysThere) {
  EXPECT_THAT(argv_of(R"xml(<node exec="prog"/>)xml"), ElementsAre("prog", "--ros-args"));
}

TEST(Node, OrderOfArgvIsThatOfRos2) {
  EXPECT_THAT(argv_of(R"xml(
    <node exec="prog" name="n" namespace="ns" args="a 'b c'" ros_args="--log-level debug">
      <remap from="chatter" to="/out"/>
      <param name="p" value="1"/>
      <remap from="~/x" to="y"/>
    </node>)xml"),
              ElementsAre("prog", "a", "b c", "--ros-args", "--log-level", "debug", "--ros-args", "-r", "__node:=n",
                          "-r", "__ns:=/ns", "--params-file", "", "-r", "chatter:=/out", "-r", "~/x:=y"));
}

struct NamespaceCase {
  const char* pushed;
  const char* given;
  const char* expected;
};

void PrintTo(const NamespaceCase& row, std::ostream* out) {
  *out << "expected " << row.expected;
}

class NodeNamespace : public testing::TestWithParam<NamespaceCase> {};

TEST_P(NodeNamespace, IsCombinedWithThatOfTheScope) {
  const NamespaceCase& row = GetParam();
  test_support::PlanOptions options;
  if (row.pushed != nullptr) {
    options.arguments.emplace("ros_namespace", row.pushed);
  }
  const std::string attribute = row.given == nullptr ? "" : std::string(" namespace=\"") + row.given + "\"";
  const std::vector<std::string> argv = argv_of("<node exec=\"prog\"" + attribute + "/>", options);
  EXPECT_EQ(argv.size() > 2 ? argv.back() : "", row.expected);
}

INSTANTIATE_TEST_SUITE_P(Vectors, NodeNamespace,
                         testing::Values(NamespaceCase{nullptr, nullptr, ""}, NamespaceCase{nullptr, "a", "__ns:=/a"},
                                         NamespaceCase{nullptr, "", "__ns:=/"}, NamespaceCase{"/a", "b", "__ns:=/a/b"},
                                         NamespaceCase{"/a", "/b", "__ns:=/b"}, NamespaceCase{"/", "b/", "__ns:=/b"},
                                         NamespaceCase{"/n1/n2", "sub", "__ns:=/n1/n2/sub"},
                                         NamespaceCase{"/a", nullptr, "__ns:=/a"}));

TEST(Node, InvalidNamesAreErrorsAtTheirPlace) {
  EXPECT_EQ(plan_actions(R"xml(<node exec="prog" name="a/b"/>)xml").error,
            "/test/system.launch.xml:2:25: error: invalid node name 'a/b'\n"
            "    2 | <node exec=\"prog\" name=\"a/b\"/>\n"
            "      |                         ^~~\n"
            "      = help: use letters, digits and underscores, not starting with a digit");
  EXPECT_THAT(plan_actions(R"xml(<node exec="prog" namespace="/a//b"/>)xml").error,
              HasSubstr("the resulting namespace is invalid: '/a//b'"));
  EXPECT_THAT(plan_actions(R"xml(<node exec="prog" namespace="1a"/>)xml").error,
              HasSubstr("the resulting namespace is invalid: '/1a'"));
}

TEST(Node, TwoWithOneNameGiveAWarning) {
  const Planned planned = plan_actions(R"xml(
    <node exec="p" name="n" namespace="a"/><node exec="p" name="n" namespace="a"/><node exec="p" name="n"/>)xml");
  EXPECT_THAT(
      planned.messages,
      ElementsAre("[launch_ros.actions.node] there are now at least 2 nodes with the name /a/n created within this "
                  "launch context"));
}

TEST(Node, LabelIsTheBaseNameOfTheProgram) {
  EXPECT_EQ(plan_actions(R"xml(<node exec="/opt/bin/prog"/>)xml").plan.processes.at(0).name, "prog");
  EXPECT_EQ(plan_actions(R"xml(<node exec="prog" name="n" exec_name="label"/>)xml").plan.processes.at(0).name, "label");
  EXPECT_EQ(plan_actions(R"xml(<node exec="prog" launch-prefix="gdb --args"/>)xml").plan.processes.at(0).name, "gdb");
}

TEST(Node, MisspeltAttributeGetsASuggestion) {
  EXPECT_EQ(plan_actions(R"xml(<node pkg="demo" exce="talker"/>)xml").error,
            "/test/system.launch.xml:2:18: error: unexpected attribute 'exce' in 'node'\n"
            "    2 | <node pkg=\"demo\" exce=\"talker\"/>\n"
            "      |                  ^~~~\n"
            "      = help: did you mean 'exec'?\n"
            "/test/system.launch.xml:2:2: error: attribute 'exec' not found in entity 'node'\n"
            "    2 | <node pkg=\"demo\" exce=\"talker\"/>\n"
            "      |  ^~~~\n"
            "      = help: exec: the program, looked up in the package");
}

class NodeInPackage : public testing::Test {
 protected:
  NodeInPackage() {
    char pattern[] = "/tmp/node-in-package-XXXXXX";
    prefix_ = ::mkdtemp(pattern);
    fs::create_directories(prefix_ / "share/ament_index/resource_index/packages");
    fs::create_directories(prefix_ / "lib/demo");
    std::ofstream(prefix_ / "share/ament_index/resource_index/packages/demo");
    std::ofstream(prefix_ / "lib/demo/talker");
    ::chmod((prefix_ / "lib/demo/talker").c_str(), 0755);
    options_.environment["AMENT_PREFIX_PATH"] = prefix_.string();
  }
  ~NodeInPackage() override { fs::remove_all(prefix_); }

  fs::path prefix_;
  test_support::PlanOptions options_;
};

TEST_F(NodeInPackage, ProgramIsFoundInTheLibexecDirectory) {
  EXPECT_THAT(argv_of(R"xml(<node pkg="demo" exec="talker"/>)xml", options_),
              ElementsAre((prefix_ / "lib/demo/talker").string(), "--ros-args"));
}

TEST_F(NodeInPackage, MissingPackageAndProgramAreErrorsWithSuggestions) {
  const std::string package_error = plan_actions(R"xml(<node pkg="dmo" exec="talker"/>)xml", options_).error;
  EXPECT_THAT(package_error, HasSubstr(":2:12: error: package 'dmo' not found"));
  EXPECT_THAT(package_error, HasSubstr("did you mean 'demo'?"));
  const std::string program_error = plan_actions(R"xml(<node pkg="demo" exec="talkr"/>)xml", options_).error;
  EXPECT_THAT(program_error, HasSubstr(":2:24: error: executable 'talkr' not found on the libexec directory"));
  EXPECT_THAT(program_error, HasSubstr("did you mean 'talker'?"));
}

TEST_F(NodeInPackage, ParameterFilesArePassedUnread) {
  const std::string file = (prefix_ / "params.yaml").string();
  std::ofstream(file) << "/**: {ros__parameters: {a: $(var a)}}\n";
  EXPECT_THAT(argv_of("<node exec=\"p\"><param from=\"" + file + "\"/></node>"),
              ElementsAre("p", "--ros-args", "--params-file", file));

  const Planned performed = plan_actions("<let name=\"a\" value=\"7\"/><node exec=\"p\"><param from=\"" + file +
                                         "\" allow_substs=\"true\"/></node>");
  EXPECT_EQ(performed.error, "");
  EXPECT_EQ(performed.plan.processes.at(0).files.at(0).content, "/**: {ros__parameters: {a: 7}}\n");

  const Planned missing = plan_actions(R"xml(<node exec="p"><param from="/no/such.yaml"/></node>)xml");
  EXPECT_THAT(missing.messages,
              ElementsAre("[launch_ros.actions.node] /test/system.launch.xml:2:29: parameter file path is "
                          "not a file: /no/such.yaml"));
  EXPECT_THAT(missing.plan.processes.at(0).argv, ElementsAre("p", "--ros-args"));
}

TEST(NodeParameters, AreWrittenForTheNodeOrForAnyNode) {
  const Planned planned = plan_actions(R"xml(
    <node exec="p" name="talker" namespace="left">
      <param name="g"><param name="h" value="true"/><param name="i"><param name="j" value="x"/></param></param>
    </node>
    <node exec="p" name="talker"><param name="rate" value="10"/></node>)xml");
  ASSERT_EQ(planned.error, "");
  EXPECT_EQ(planned.plan.processes.at(0).files.at(0).content,
            "/left/talker:\n  ros__parameters:\n    g.h: true\n    g.i.j: \"x\"\n");
  EXPECT_EQ(planned.plan.processes.at(0).files.at(0).argument, 7U);
  EXPECT_EQ(planned.plan.processes.at(1).files.at(0).content, "/**:\n  ros__parameters:\n    rate: 10\n");
}

TEST(NodeParameters, AFileWithoutASectionForTheNodeIsTold) {
  const auto path = std::filesystem::temp_directory_path() / ("sections_" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(path) << "ctrl: {ros__parameters: {a: 1}}\n";
  const std::string param = "<param from=\"" + path.string() + "\"/></node>";
  const Planned planned = plan_actions("<node exec=\"p\" name=\"ctrl\">" + param +
                                       "\n<node exec=\"p\" name=\"ctrl\" namespace=\"robot1\">" + param);
  std::filesystem::remove(path);
  ASSERT_EQ(planned.error, "");
  EXPECT_THAT(planned.messages,
              ElementsAre("[launch_ros.actions.node] /test/system.launch.xml:3:60: no section of '" + path.string() +
                          "' is for /robot1/ctrl (sections: ctrl; did you mean '/robot1/ctrl' or '/**/ctrl'?)"));
}

TEST(NodeParameters, FormsThatExcludeEachOtherAreErrors) {
  const auto error = [](const std::string& params) {
    return plan_actions("<node exec=\"p\">" + params + "</node>").error;
  };
  EXPECT_THAT(error(R"xml(<param name="a" value="1" from="f"/>)xml"),
              HasSubstr("name and from attributes are mutually exclusive"));
  EXPECT_THAT(error(R"xml(<param name="a" value="1"><param name="b" value="2"/></param>)xml"),
              HasSubstr("nested parameters and value attributes are mutually exclusive"));
  EXPECT_THAT(error(R"xml(<param name="a"/>)xml"), HasSubstr("either a value attribute or nested params are needed"));
  EXPECT_THAT(error(R"xml(<param value="1"/>)xml"), HasSubstr("param entity should have a name or a from attribute"));
  EXPECT_THAT(error(R"xml(<param name="a" value="1" allow_substs="true"/>)xml"),
              HasSubstr("allow_substs can only be used with from"));
  EXPECT_THAT(error(R"xml(<param name="a" value="1" type="integer"/>)xml"),
              HasSubstr("got invalid type identifier 'integer'"));
}

}  // namespace
