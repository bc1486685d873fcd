// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/frontend/entity_test_support.hpp"

namespace launch {
namespace {

TEST(YamlFrontend, GivesActionsAttributesAndTheirPlaces) {
  const Entity root = yaml("launch:\n- node: {pkg: demo, exec: \"talker\"}\n");
  EXPECT_EQ(root.type_name, "launch");
  EXPECT_EQ(raw(root.where), "launch");
  ASSERT_EQ(root.children.size(), 1U);
  const Entity& node = root.children[0];
  EXPECT_EQ(node.type_name, "node");
  EXPECT_EQ(to_string(node.where), "t.launch.yaml:2:3");
  EXPECT_FALSE(node.has_children_list);
  ASSERT_EQ(node.attributes.size(), 2U);
  EXPECT_EQ(raw(node.attributes[0].name_where), "pkg");
  EXPECT_EQ(raw(node.attributes[1].value.where), "talker");
}

TEST(YamlFrontend, TypesPlainScalarsAndTakesQuotedOnesAsText) {
  const Entity root = yaml("launch:\n- x: {a: 1, b: '1', c: yes, d: \"~\", e: ~, f: 1.5, g: !!str 1, h: 2024-01-01}\n");
  const auto type = [&](std::string_view name) { return root.children[0].find(name)->value.scalar()->type; };
  EXPECT_EQ(type("a"), Scalar::Type::kInt);
  EXPECT_EQ(type("b"), Scalar::Type::kString);
  EXPECT_EQ(type("c"), Scalar::Type::kBool);
  EXPECT_EQ(type("d"), Scalar::Type::kString);
  EXPECT_EQ(type("e"), Scalar::Type::kNull);
  EXPECT_EQ(type("f"), Scalar::Type::kFloat);
  EXPECT_EQ(type("g"), Scalar::Type::kString);
  EXPECT_EQ(type("h"), Scalar::Type::kOther);
}

TEST(YamlFrontend, ACarriageReturnAloneEndsALine) {
  const Entity root = yaml("launch:\r- log: {message: a}\r- log:\r    message: 'b'\r");
  ASSERT_EQ(root.children.size(), 2U);
  EXPECT_EQ(root.children[1].find("message")->value.scalar()->text.text(), "b");
  EXPECT_EQ(to_string(root.children[1].where), "t.launch.yaml:3:3");
}

TEST(YamlFrontend, ATagMakesAFloatOfAnyNumber) {
  const Entity root = yaml("launch:\n- x: {a: !!float 10, b: !!float 1e3, c: !!float +1_6}\n");
  for (const auto& [name, number] : {std::pair("a", 10.0), std::pair("b", 1000.0), std::pair("c", 16.0)}) {
    const Scalar* const scalar = root.children[0].find(name)->value.scalar();
    EXPECT_EQ(scalar->type, Scalar::Type::kFloat) << name;
    EXPECT_EQ(scalar->float_value, number) << name;
  }
}

TEST(YamlFrontend, GivesSubActionsFromAListOrFromChildren) {
  const Entity root = yaml(
      "launch:\n- group:\n  - log: {message: a}\n- group:\n    if: 'true'\n    children:\n    - log: {message: b}\n"
      "- group: {children: []}\n- group: {if: 'true'}\n");
  EXPECT_EQ(text_of(root.children[0].children[0], "message"), "a");
  EXPECT_TRUE(root.children[0].has_children_list);
  EXPECT_EQ(text_of(root.children[1].children[0], "message"), "b");
  EXPECT_TRUE(root.children[2].has_children_list);
  EXPECT_FALSE(root.children[3].has_children_list);
}

TEST(YamlFrontend, MakesAChildOfEachMappingInAList) {
  const Entity root =
      yaml("launch:\n- node:\n    param:\n    - name: a\n      param: [{name: b, value: [1, 2]}]\n    - {from: x}\n");
  const Entity& node = root.children[0];
  ASSERT_EQ(node.children.size(), 2U);
  EXPECT_EQ(node.children[0].type_name, "param");
  EXPECT_EQ(to_string(node.children[0].where), "t.launch.yaml:4:7");
  EXPECT_EQ(to_string(node.children[1].where), "t.launch.yaml:6:7");
  const Entity& inner = node.children[0].children.at(0);
  ASSERT_NE(inner.find("value")->value.list(), nullptr);
  EXPECT_EQ(inner.find("value")->value.list()->size(), 2U);
}

TEST(YamlFrontend, LeavesAnEmptyListToTheActionToJudge) {
  const Entity root = yaml("launch:\n- x: {value: [], param: []}\n");
  ASSERT_NE(root.children[0].find("param")->value.list(), nullptr);
  EXPECT_TRUE(root.children[0].find("param")->value.list()->empty());
}

TEST(YamlFrontend, KeepsPlacesInsideEscapesFoldsAndBlocks) {
  const Entity root = yaml(
      "launch:\n"
      "- log: {message: \"a\\t\\u00e4$(x)\"}\n"
      "- log: {message: 'it''s $(x)'}\n"
      "- log:\n    message: plain\n      folded   $(x)\n"
      "- log:\n    message: |\n      one\n\n        two $(x)\n      three $(y)\n"
      "- log:\n    message: >-\n      one\n      two $(x)\n\n      three $(y)\n"
      "- log:\n    message: \"one\n      two \\\n      $(x)\"\n"
      "- log: {message: &anchor !!str $(x)}\n");
  const auto place_of = [&](std::size_t action, std::string_view what) {
    const LocatedText& text = root.children[action].find("message")->value.scalar()->text;
    const SourceRange range = text.range(text.text().find(what), what.size());
    EXPECT_EQ(raw(range), what);
    return to_string(range);
  };
  EXPECT_EQ(text_of(root.children[0], "message"), "a\t\xC3\xA4$(x)");
  EXPECT_EQ(place_of(0, "$(x)"), "t.launch.yaml:2:28");
  EXPECT_EQ(place_of(1, "$(x)"), "t.launch.yaml:3:25");
  EXPECT_EQ(text_of(root.children[2], "message"), "plain folded   $(x)");
  EXPECT_EQ(place_of(2, "$(x)"), "t.launch.yaml:6:16");
  EXPECT_EQ(text_of(root.children[3], "message"), "one\n\n  two $(x)\nthree $(y)\n");
  EXPECT_EQ(place_of(3, "$(x)"), "t.launch.yaml:11:13");
  EXPECT_EQ(place_of(3, "$(y)"), "t.launch.yaml:12:13");
  EXPECT_EQ(text_of(root.children[4], "message"), "one two $(x)\nthree $(y)");
  EXPECT_EQ(place_of(4, "$(x)"), "t.launch.yaml:16:11");
  EXPECT_EQ(place_of(4, "$(y)"), "t.launch.yaml:18:13");
  EXPECT_EQ(place_of(5, "$(x)"), "t.launch.yaml:22:7");
  EXPECT_EQ(place_of(6, "$(x)"), "t.launch.yaml:23:32");
}

TEST(YamlFrontend, KeepsPlacesBehindAByteOrderMarkAndWithCrlf) {
  const Entity root = yaml("\xEF\xBB\xBFlaunch:\r\n- log:\r\n    message: |\r\n      a\r\n      $(x)\r\n");
  const LocatedText& text = root.children[0].find("message")->value.scalar()->text;
  EXPECT_EQ(raw(root.children[0].where), "log");
  EXPECT_EQ(raw(text.range(text.text().find("$(x)"), 4)), "$(x)");
}

TEST(YamlFrontend, ResolvesAliasesAndMergeKeysAsPyYamlDoes) {
  const Entity root = yaml(
      "launch:\n"
      "- node: &base {pkg: p, exec: e, name: base}\n"
      "- node: {<<: *base, name: own}\n"
      "- node: {<<: [{pkg: first}, *base], exec: &run run}\n"
      "- node: {'<<': text, exec: *run}\n");
  EXPECT_EQ(text_of(root.children[1], "pkg"), "p");
  EXPECT_EQ(text_of(root.children[1], "name"), "own");
  EXPECT_EQ(root.children[1].attributes.size(), 3U);
  EXPECT_EQ(text_of(root.children[2], "pkg"), "first");
  EXPECT_EQ(text_of(root.children[2], "exec"), "run");
  EXPECT_EQ(text_of(root.children[2], "name"), "base");
  EXPECT_EQ(text_of(root.children[3], "<<"), "text") << "quoted, it is a key like others";
  EXPECT_EQ(text_of(root.children[3], "exec"), "run");
}

// Each anchor is as deep as brackets may be, and stands on the one before.
TEST(YamlFrontend, AliasesDoNotNestDeeperThanBrackets) {
  std::string text = "launch:\n- let:\n    name: x\n    value:\n";
  for (int i = 1; i <= 3; ++i) {
    text += "    - &a" + std::to_string(i) + " " + std::string(300, '[') +
            (i > 1 ? "*a" + std::to_string(i - 1) + " " : "x") + std::string(300, ']') + "\n";
  }
  EXPECT_NE(load_error(file_of("t.launch.yaml", text)).find("the aliases nest more than 500 levels deep"),
            std::string::npos);
}

TEST(YamlFrontend, RefusesAliasesThatContainThemselvesOrExplode) {
  EXPECT_THROW(yaml("launch: &a\n- group: *a\n"), LaunchError);
  std::string text = "launch:\n- x: {a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]";
  for (int i = 1; i < 10; ++i) {
    text += ", a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int j = 0; j < 10; ++j) {
      text += (j > 0 ? ", *a" : "*a") + std::to_string(i - 1);
    }
    text += "]";
  }
  EXPECT_NE(load_error(file_of("t.launch.yaml", text + "}\n")).find("the aliases expand to more than 1000000 nodes"),
            std::string::npos);
}

TEST(YamlFrontend, ChoosesTheFormatByTheContent) {
  EXPECT_EQ(load_error(file_of("yaml_inside.launch.xml", "launch: []\n")), "");
  EXPECT_EQ(load_error(file_of("xml_inside.launch.yaml", "\n  <launch/>\n")), "");
  EXPECT_EQ(load_error(file_of("no_suffix", "<launch/>")), "");
  EXPECT_EQ(load_error(file_of("no_suffix", "launch: []")), "");
}

TEST(YamlFrontend, ReadsManyActionsInLinearTime) {
  std::string text = "launch:\n";
  for (int i = 0; i < 10'000; ++i) {
    text += "- let: {name: a, value: \"$(var x)\"}\n- executable:\n    cmd: sleep 1\n    output: screen\n";
  }
  EXPECT_EQ(yaml(text).children.size(), 20'000U);
}

}  // namespace
}  // namespace launch
