// SPDX-License-Identifier: Apache-2.0
// What parameter files hold for nodes and components, and what is wrong in them.
#include "actions/parameters/parameter_reader.hpp"

#include <gmock/gmock.h>

#include "actions/parameters/node_pattern.hpp"
#include "actions/parameters/parameter_file.hpp"
#include "launcher/language/parameter_value.hpp"

namespace {

using launch::Diagnostic;
using launch::FileParameter;
using launch::ParameterSection;
using launch::ParameterSections;
using launch::SourceFile;
using testing::ElementsAre;
using testing::IsEmpty;

ParameterSections read(const std::string& text) {
  const auto file = std::make_shared<const SourceFile>("/p.yaml", text);
  return launch::read_parameter_sections(launch::LocatedText(text, {file, 0, static_cast<std::uint32_t>(text.size())}));
}

std::string text_of(const Diagnostic& diagnostic) {
  return to_string(diagnostic.where) + ": " + diagnostic.message +
         (diagnostic.help.empty() ? "" : " (" + diagnostic.help + ")");
}

// Of one section for all nodes.
std::vector<std::string> values(const std::string& parameters) {
  std::vector<std::string> texts;
  const ParameterSections found = read("/**: {ros__parameters: {" + parameters + "}}");
  for (const FileParameter& parameter : found.sections.at(0).parameters) {
    texts.push_back(parameter.name + "=" + launch::to_yaml(parameter.value));
  }
  return texts;
}

std::vector<std::string> errors(const std::string& parameters) {
  std::vector<std::string> texts;
  const ParameterSections found = read("n:\n  ros__parameters:\n" + parameters);
  for (const Diagnostic& error : found.sections.at(0).errors) {
    texts.push_back(text_of(error));
  }
  return texts;
}

TEST(ParameterFile, ValuesHaveTheTypesOfANode) {
  EXPECT_THAT(
      values("a: nan, b: inf, c: .nan, d: 5e-06, e: 1.0e+20, g: 0x1F, h: 010, i: 1_000, j: 1e3, k: y, l: \"on\""),
      ElementsAre("a=.nan", "b=.inf", "c=.nan", "d=5e-06", "e=1e+20", "g=31", "h=8", "i=\"1_000\"", "j=1000.0",
                  "k=true", "l=\"on\""));
  EXPECT_THAT(values("n: 1:30, o: 2026-01-01, p: !!str 5, q: !!float 3, r: '', s: ~, t: null"),
              ElementsAre("n=\"1:30\"", "o=\"2026-01-01\"", "p=\"5\"", "q=3.0", "r=\"\"", "s=\"~\"", "t=\"null\""));
  EXPECT_THAT(values("a: [1.0e-5, 2e-5], b: [!!float 1, 2.5], c: [], d: [a, '1'], e: [on, off]"),
              ElementsAre("a=[1e-05, 2e-05]", "b=[1.0, 2.5]", "c=[]", "d=[\"a\", \"1\"]", "e=[true, false]"));
  EXPECT_THAT(values("a: !!binary AQI=, b: [!!binary AQ==, !!binary Aw==]"),
              ElementsAre("a=[!!binary AQ==, !!binary Ag==]", "b=[!!binary AQ==, !!binary Aw==]"));
  EXPECT_THAT(values("a: {b: {c: 1}, d.e: 2}, a.b: 3"), ElementsAre("a.b.c=1", "a.d.e=2", "a.b=3"));
}

TEST(ParameterFile, TextsOfBlocksAreNotQuoted) {
  const auto sections =
      read("/**:\n  ros__parameters:\n    a: |\n      5\n    b: >-\n      true\n    c: !!str |-\n      7\n").sections;
  ASSERT_EQ(sections.size(), 1U);
  ASSERT_EQ(sections[0].parameters.size(), 3U);
  EXPECT_EQ(launch::to_yaml(sections[0].parameters[0].value), "\"5\\n\"");
  EXPECT_EQ(launch::to_yaml(sections[0].parameters[1].value), "true");
  EXPECT_EQ(launch::to_yaml(sections[0].parameters[2].value), "\"7\"");
}

TEST(ParameterFile, ErrorsStandAtTheValue) {
  EXPECT_THAT(errors("    a: [1, 2.5]\n    b: [1, x]\n    c: [[1], [2]]\n    d: [{e: 1}]\n"),
              ElementsAre("/p.yaml:3:12: the list of parameter 'a' must be of one type: it begins with an integer and "
                          "has a double (give each number a point: 1.0)",
                          "/p.yaml:4:12: the list of parameter 'b' must be of one type: it begins with an integer and "
                          "has a string (in quotes, all of them are strings)",
                          "/p.yaml:5:9: the list of parameter 'c' holds a list (a parameter is a bool, an integer, a "
                          "double, a string, or a list of one of these)",
                          "/p.yaml:6:9: the list of parameter 'd' holds a mapping (a parameter is a bool, an integer, "
                          "a double, a string, or a list of one of these)"));
  EXPECT_THAT(errors("    a:\n    b: {c: }\n    d: [1, ]\n    e: !!str\n    null: 1\n"),
              ElementsAre("/p.yaml:3:5: parameter 'a' has no value (an empty text is written \"\")",
                          "/p.yaml:4:9: parameter 'b.c' has no value (an empty text is written \"\")",
                          "/p.yaml:6:5: parameter 'e' has no value (an empty text is written \"\")"));
  EXPECT_THAT(
      errors("    a: !!int abc\n    b: !!timestamp 2026-01-01\n    c: !!map [1]\n    d: !!seq {e: 1}\n    f: !deg 1\n"),
      ElementsAre("/p.yaml:3:14: parameter 'a': 'abc' is no integer, as the tag !!int says (remove the tag)",
                  "/p.yaml:4:20: parameter 'b': the tag '!!timestamp' is not one of !!bool, !!int, !!float, !!str, "
                  "!!binary (remove the tag)",
                  "/p.yaml:5:8: the tag '!!map' does not fit a list (remove the tag)",
                  "/p.yaml:6:8: the tag '!!seq' does not fit a mapping (remove the tag)",
                  "/p.yaml:7:13: parameter 'f': the tag '!deg' is not one of !!bool, !!int, !!float, !!str, !!binary "
                  "(remove the tag)"));
}

std::string refusal(const std::string& text) {
  const ParameterSections found = read(text);
  return found.no_yaml ? text_of(*found.no_yaml) : found.node_refuses ? text_of(*found.node_refuses) : "";
}

TEST(ParameterFile, SaysWhatANodeRefusesAboveTheParameters) {
  EXPECT_EQ(refusal(""), "");
  EXPECT_EQ(refusal("# nothing\n"), "");
  EXPECT_EQ(refusal("a: {ros__parameters: {}}"), "");
  EXPECT_EQ(refusal("- a"),
            "/p.yaml:1:1: expected a mapping of nodes, got a list (parameters stand below NODE: "
            "ros__parameters:)");
  EXPECT_EQ(refusal("text"),
            "/p.yaml:1:1: expected a mapping of nodes, got a value (parameters stand below NODE: "
            "ros__parameters:)");
  EXPECT_EQ(refusal("a:\n  b: 1"),
            "/p.yaml:2:3: 'b' stands outside of ros__parameters (parameters stand below NODE: ros__parameters:)");
  EXPECT_EQ(
      refusal("a:\n  ros__parameters:\n"),
      "/p.yaml:2:3: ros__parameters must hold parameters as NAME: VALUE (write {} for none, or leave out the name "
      "of the node)");
  EXPECT_EQ(refusal("ros__parameters: {a: 1}"),
            "/p.yaml:1:1: ros__parameters stands below no name of a node (for all nodes write /**: above it)");
  EXPECT_EQ(
      refusal("/a:\n  my-node: {ros__parameters: {a: 1}}"),
      "/p.yaml:2:3: '/a/my-node' is no name of a node (parts of letters, digits and underscores, not starting with "
      "a digit, with single slashes between; * stands for one part, ** for any number)");
  EXPECT_EQ(refusal("a: {ros__parameters: &x {b: 1}}\nc: *x"),
            "/p.yaml:2:4: a node reads no aliases (write the value itself in place of the alias)");
  EXPECT_EQ(refusal("a: {ros__parameters: {b: 1"), "/p.yaml:1:27: expected ',' or '}'");
  EXPECT_EQ(refusal("a: {ros__parameters: {b: 1}}\nb:\n"),
            "/p.yaml:2:1: 'b' stands outside of ros__parameters (parameters stand below NODE: ros__parameters:)");
  EXPECT_EQ(refusal("a:\n  ros__parameters:\n    b: 1\n    c\n"),
            "/p.yaml:4:5: expected 'KEY: VALUE' (a ':' with a space after it is missing)");
}

TEST(ParameterFile, AliasesAndMergeKeysAreForComponents) {
  const ParameterSections found = read(
      "/a:\n  ros__parameters: &all\n    x: 1\n    y: 2\n/b:\n  ros__parameters:\n    <<: *all\n    y: 3\n    z: {<<: "
      "*all}\n");
  ASSERT_EQ(found.sections.size(), 2U);
  std::vector<std::string> names;
  for (const FileParameter& parameter : found.sections[1].parameters) {
    names.push_back(parameter.name + "=" + launch::to_yaml(parameter.value));
  }
  EXPECT_THAT(names, ElementsAre("y=3", "z.x=1", "z.y=2", "x=1"));
  EXPECT_TRUE(found.node_refuses);
}

TEST(ParameterFile, AComponentMayHaveAListThatOnlyANodeRefuses) {
  const ParameterSections found = read("/**: {ros__parameters: {a: [x, y], b: [1e3, c], d: [1, 2.5]}}");
  ASSERT_EQ(found.sections.size(), 1U);
  const ParameterSection& section = found.sections[0];
  ASSERT_EQ(section.parameters.size(), 2U);
  EXPECT_EQ(launch::to_yaml(section.parameters[0].value), "[\"x\", \"y\"]");
  EXPECT_EQ(launch::to_yaml(section.parameters[1].value), "[\"1e3\", \"c\"]");
  ASSERT_EQ(section.node_errors.size(), 2U);
  EXPECT_EQ(text_of(section.node_errors[0]),
            "/p.yaml:1:32: the list of parameter 'a' must be of one type: it begins with a string and has a bool (in "
            "quotes, all of them are strings)");
  EXPECT_EQ(section.errors.size(), 1U);
}

TEST(ParameterFile, AliasesThatExplodeAreRefused) {
  std::string text = "a0: &a0 {x: 1}\n";
  for (int i = 1; i < 40; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " {x: " + last + ", y: " + last + "}\n";
  }
  const ParameterSections found = read(text);
  ASSERT_TRUE(found.no_yaml);
  EXPECT_EQ(found.no_yaml->message,
            "the aliases expand to more than 1000000 nodes, or 500 merge keys stand inside each other");
  EXPECT_EQ(refusal("a: &x {b: *x}"), "/p.yaml:1:11: the alias stands inside the node that it refers to");
}

TEST(ParameterFile, SaysWhereRos2ReadsOtherwiseForAComponent) {
  std::vector<std::string> found;
  const ParameterSections sections = read(
      "n: {ros__parameters: {a: 5e-06, b: 1_000, c: y, d: 2026-01-01, e: 1:30, f: ~, g: [1.5, inf], h: 1, i: 1.5, "
      "j: yes, k: 'y', l: .inf, m: text, n: 0x1F, o: 010, p: 1.0e+3}}");
  for (const FileParameter& parameter : sections.sections.at(0).parameters) {
    if (parameter.ros2_component) {
      found.push_back(parameter.ros2_component->message);
    }
  }
  EXPECT_THAT(found,
              ElementsAre("'5e-06' is a double; for a component, ROS 2 makes it a string",
                          "'1_000' is a string; for a component, ROS 2 makes it the integer 1000",
                          "'y' is a bool; for a component, ROS 2 makes it a string",
                          "'2026-01-01' is a string; for a component, ROS 2 makes it a date, so that the component "
                          "is not loaded",
                          "'1:30' is a string; for a component, ROS 2 makes it the integer 90",
                          "'~' is a string; for a component, ROS 2 makes it nothing, so that the component is not "
                          "loaded",
                          "'inf' is a double; for a component, ROS 2 makes it a string"));
}

TEST(NodePattern, StandsForParts) {
  EXPECT_TRUE(launch::is_for_node("/**", "/a/b"));
  EXPECT_TRUE(launch::is_for_node("b", "/b"));
  EXPECT_FALSE(launch::is_for_node("b", "/a/b"));
  EXPECT_TRUE(launch::is_for_node("/*/b", "/a/b"));
  EXPECT_FALSE(launch::is_for_node("/*", "/a/b"));
  EXPECT_TRUE(launch::is_for_node("/**/b", "/b"));
  EXPECT_TRUE(launch::is_for_namespace("/a/b", "/a"));
  EXPECT_TRUE(launch::is_for_namespace("/**", "/a"));
  EXPECT_FALSE(launch::is_for_namespace("b", "/a"));
  EXPECT_FALSE(launch::is_for_namespace("/b/c", "/a"));
}

TEST(NodeName, IsThatOfTheFirstRemap) {
  const auto known = [](const std::vector<std::string>& argv) {
    const launch::KnownNodeName node = launch::known_node_name(argv);
    return node.name_space.value_or("-") + " " + node.name.value_or("-");
  };
  EXPECT_EQ(known({"p", "--ros-args"}), "- -");
  EXPECT_EQ(known({"p", "--ros-args", "-r", "__node:=a", "-r", "__ns:=/x", "--remap", "__node:=b"}), "/x a");
  EXPECT_EQ(known({"p", "--remap", "__ns:=/y", "-r", "__ns:=/x"}), "/y -");
  EXPECT_EQ(known({"p", "-r", "old:__node:=a", "-r", "__node:=b"}), "- -");
  EXPECT_EQ(known({"/lib/component_container_mt", "-r", "__node:=a"}), "- -");
}

}  // namespace
