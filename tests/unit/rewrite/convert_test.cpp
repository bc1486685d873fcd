// SPDX-License-Identifier: Apache-2.0
// Launch files in another of the three languages. That plans stay the same is shown in
// tests/e2e/command_line/rewrite_test.py.
#include "programs/launch/rewrite/convert.hpp"

#include <gtest/gtest.h>

#include "actions/builtin_actions.hpp"
#include "launcher/frontend/frontend.hpp"

namespace launch {
namespace {

using Convert = Converted (*)(const Entity&, Comments, const Registry&);

Converted convert(Convert to, const std::string& text) {
  static const Registry registry = builtin_actions();
  const auto file = std::make_shared<SourceFile>("a", text);
  return to(load_entity_tree(file), Comments(file), registry);
}

constexpr const char* kXml =
    "<!-- the file -->\n"
    "<launch>\n"
    "  <arg name=\"x\" default=\"1\" description=\"it's\"/>\n"
    "\n"
    "  <!-- a node -->\n"
    "  <node pkg=\"a\" exec=\"talker\" args=\"-v '$(var x) b'\" respawn=\"true\" if=\"$(var x)\">\n"
    "    <param name=\"p\" value=\"1\"/>\n"
    "    <remap from=\"a\" to=\"b\"/>\n"
    "    <param name=\"q\" value=\"'1'\"/>\n"
    "  </node>\n"
    "  <group>\n"
    "    <let name=\"y\" value=\"a: b\"/>\n"
    "  </group>\n"
    "</launch>\n";

constexpr const char* kYaml =
    "# the file\n"
    "launch:\n"
    "- arg: {name: x, default: \"1\", description: it's}\n"
    "\n"
    "# a node\n"
    "- node:\n"
    "    pkg: a\n"
    "    exec: talker\n"
    "    args: \"-v '$(var x) b'\"\n"
    "    respawn: \"true\"\n"
    "    if: $(var x)\n"
    "    param:\n"
    "    - {name: p, value: 1}\n"
    "    - {name: q, value: '1'}\n"
    "    remap:\n"
    "    - {from: a, to: b}\n"
    "- group:\n"
    "    children:\n"
    "    - let: {name: y, value: \"a: b\"}\n";

TEST(Convert, SaysWhichNamesOfYamlXmlCannotHave) {
  const Converted made = convert(convert_to_xml, "launch:\n- ex/cutable: {cmd: a}\n- executable: {'c md': a}\n");
  ASSERT_EQ(made.errors.size(), 2u);
  EXPECT_EQ(made.errors[0].message, "'ex/cutable' is no name of XML");
  EXPECT_EQ(made.errors[1].message, "'c md' is no name of XML");
}

TEST(Convert, WritesYamlFromXml) {
  const Converted made = convert(convert_to_yaml, kXml);
  EXPECT_TRUE(made.errors.empty());
  EXPECT_EQ(made.text, kYaml);
}

TEST(Convert, WritesXmlFromYaml) {
  const Converted made = convert(convert_to_xml, kYaml);
  EXPECT_TRUE(made.errors.empty());
  EXPECT_EQ(made.text,
            "<!-- the file -->\n"
            "<launch>\n"
            "  <arg name=\"x\" default=\"1\" description=\"it's\"/>\n"
            "\n"
            "  <!-- a node -->\n"
            "  <node pkg=\"a\" exec=\"talker\" args=\"-v '$(var x) b'\" respawn=\"true\" if=\"$(var x)\">\n"
            "    <param name=\"p\" value=\"1\"/>\n"
            "    <param name=\"q\" value=\"&quot;1&quot;\"/>\n"
            "    <remap from=\"a\" to=\"b\"/>\n"
            "  </node>\n"
            "  <group>\n"
            "    <let name=\"y\" value=\"a: b\"/>\n"
            "  </group>\n"
            "</launch>\n");
}

TEST(Convert, WritesPythonFromXml) {
  const Converted made = convert(convert_to_python, kXml);
  EXPECT_TRUE(made.errors.empty());
  EXPECT_EQ(made.text,
            "# the file\n"
            "from launch import LaunchDescription\n"
            "from launch.actions import DeclareLaunchArgument, GroupAction, SetLaunchConfiguration\n"
            "from launch.conditions import IfCondition\n"
            "from launch.substitutions import LaunchConfiguration\n"
            "from launch_ros.actions import Node\n"
            "\n\n"
            "def generate_launch_description():\n"
            "    return LaunchDescription([\n"
            "        DeclareLaunchArgument(name='x', default_value='1', description='it\\'s'),\n"
            "\n"
            "        # a node\n"
            "        Node(\n"
            "            package='a',\n"
            "            executable='talker',\n"
            "            arguments=['-v', [LaunchConfiguration('x'), ' b']],\n"
            "            respawn=True,\n"
            "            condition=IfCondition(LaunchConfiguration('x')),\n"
            "            parameters=[{'p': 1}, {'q': '1'}],\n"
            "            remappings=[('a', 'b')],\n"
            "        ),\n"
            "        GroupAction([\n"
            "            SetLaunchConfiguration(name='y', value='a: b'),\n"
            "        ]),\n"
            "    ])\n");
}

TEST(Convert, NamesWhatHasNoFormInTheOtherLanguage) {
  const Converted made =
      convert(convert_to_python, "<launch><log message=\"$(index i)\" level=\"INFO\"/><reset_all/></launch>");
  ASSERT_EQ(made.errors.size(), 2U);
  EXPECT_EQ(made.errors[0].message, "launch convert knows no form in Python for this use of $(index)");
  EXPECT_EQ(made.errors[1].message, "launch convert knows no form in Python for 'reset_all'");
  EXPECT_EQ(made.errors[1].where.begin, 49U);
}

}  // namespace
}  // namespace launch
