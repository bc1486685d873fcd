// SPDX-License-Identifier: Apache-2.0
#include "rcl_test.hpp"

namespace {

using rcl_test::Arguments;
using rcl_test::take_error;
using rcl_test::take_string;

std::vector<std::string> with_rules(const std::vector<std::string>& rules) {
  std::vector<std::string> arguments{"program", "--ros-args"};
  for (const std::string& rule : rules) {
    arguments.push_back("-r");
    arguments.push_back(rule);
  }
  return arguments;
}

struct Remap {
  std::vector<std::string> rules;
  std::string name;
  std::string expected;  // empty: not remapped
};

std::ostream& operator<<(std::ostream& out, const Remap& remap) {
  for (const std::string& rule : remap.rules) {
    out << rule << ' ';
  }
  return out << "on " << remap.name;
}

class RemapTopic : public testing::TestWithParam<Remap> {};

TEST_P(RemapTopic, OfNodeTalkerInNamespaceNs) {
  const Arguments arguments(with_rules(GetParam().rules));
  ASSERT_EQ(arguments.result, RCL_RET_OK) << arguments.error;
  char* output = nullptr;
  ASSERT_EQ(rcl_remap_topic_name(nullptr, &arguments.handle, GetParam().name.c_str(), "talker", "/ns",
                                 rcl_get_default_allocator(), &output),
            RCL_RET_OK);
  EXPECT_EQ(take_string(output), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Vectors, RemapTopic,
    testing::Values(Remap{{"/ns/from:=/to"}, "/ns/from", "/to"}, Remap{{"from:=to"}, "/ns/from", "/ns/to"},
                    Remap{{"from:=/to"}, "/ns/from", "/to"}, Remap{{"from:=to"}, "/other/from", ""},
                    Remap{{"/from:=to"}, "/ns/from", ""}, Remap{{"~/x:=y"}, "/ns/talker/x", "/ns/y"},
                    Remap{{"x:=~/y"}, "/ns/x", "/ns/talker/y"}, Remap{{"a/b:=c/d/e"}, "/ns/a/b", "/ns/c/d/e"},
                    Remap{{"from:=first", "from:=second"}, "/ns/from", "/ns/first"},
                    Remap{{"from:=to", "to:=elsewhere"}, "/ns/from", "/ns/to"},
                    Remap{{"talker:from:=to"}, "/ns/from", "/ns/to"}, Remap{{"listener:from:=to"}, "/ns/from", ""},
                    Remap{{"listener:from:=x", "from:=y"}, "/ns/from", "/ns/y"},
                    Remap{{"rostopic://from:=to"}, "/ns/from", "/ns/to"},
                    Remap{{"rostopic:///from:=rostopic:///to"}, "/from", "/to"},
                    Remap{{"talker:rostopic://~/from:=to"}, "/ns/talker/from", "/ns/to"},
                    Remap{{"rosservice://from:=to"}, "/ns/from", ""}, Remap{{"__node:=x"}, "/ns/from", ""}));

TEST(RemapService, IgnoresRulesForTopics) {
  const Arguments arguments(with_rules({"rostopic://from:=x", "rosservice://from:=y"}));
  char* output = nullptr;
  ASSERT_EQ(rcl_remap_service_name(nullptr, &arguments.handle, "/ns/from", "talker", "/ns", rcl_get_default_allocator(),
                                   &output),
            RCL_RET_OK);
  EXPECT_EQ(take_string(output), "/ns/y");
}

TEST(RemapTopic, PrefersRulesOfTheNodeToThoseOfTheProcess) {
  const Arguments local(with_rules({"from:=local"}));
  const Arguments global(with_rules({"from:=global", "only_global:=x"}));
  char* output = nullptr;
  ASSERT_EQ(
      rcl_remap_topic_name(&local.handle, &global.handle, "/from", "talker", "/", rcl_get_default_allocator(), &output),
      RCL_RET_OK);
  EXPECT_EQ(take_string(output), "/local");
  ASSERT_EQ(rcl_remap_topic_name(&local.handle, &global.handle, "/only_global", "talker", "/",
                                 rcl_get_default_allocator(), &output),
            RCL_RET_OK);
  EXPECT_EQ(take_string(output), "/x");
}

struct NodeRemap {
  std::vector<std::string> rules;
  std::string name;        // of node `talker`, empty: not remapped
  std::string namespace_;  // empty: not remapped
};

std::ostream& operator<<(std::ostream& out, const NodeRemap& remap) {
  for (const std::string& rule : remap.rules) {
    out << rule << ' ';
  }
  return out;
}

class RemapNode : public testing::TestWithParam<NodeRemap> {};

TEST_P(RemapNode, OfNodeTalker) {
  const Arguments arguments(with_rules(GetParam().rules));
  ASSERT_EQ(arguments.result, RCL_RET_OK) << arguments.error;
  char* output = nullptr;
  ASSERT_EQ(rcl_remap_node_name(nullptr, &arguments.handle, "talker", rcl_get_default_allocator(), &output),
            RCL_RET_OK);
  EXPECT_EQ(take_string(output), GetParam().name);
  ASSERT_EQ(rcl_remap_node_namespace(nullptr, &arguments.handle, "talker", rcl_get_default_allocator(), &output),
            RCL_RET_OK);
  EXPECT_EQ(take_string(output), GetParam().namespace_);
}

INSTANTIATE_TEST_SUITE_P(Vectors, RemapNode,
                         testing::Values(NodeRemap{{"__node:=new"}, "new", ""}, NodeRemap{{"__name:=new"}, "new", ""},
                                         NodeRemap{{"__ns:=/a/b"}, "", "/a/b"}, NodeRemap{{"__ns:=/"}, "", "/"},
                                         NodeRemap{{"talker:__node:=new"}, "new", ""},
                                         NodeRemap{{"listener:__node:=new", "listener:__ns:=/a"}, "", ""},
                                         NodeRemap{{"listener:__ns:=/a", "__ns:=/b", "__ns:=/c"}, "", "/b"},
                                         NodeRemap{{"talker:=listener"}, "", ""}));

struct WrongRule {
  const char* rule;
  const char* message;
};

std::ostream& operator<<(std::ostream& out, const WrongRule& wrong) {
  return out << wrong.rule;
}

class WrongRemapRule : public testing::TestWithParam<WrongRule> {};

TEST_P(WrongRemapRule, IsNamedWithTheReason) {
  const Arguments arguments(with_rules({GetParam().rule}));
  EXPECT_EQ(arguments.result, RCL_RET_INVALID_ROS_ARGS);
  EXPECT_EQ(arguments.error, std::string("'-r ") + GetParam().rule + "' is no remap rule: " + GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Vectors, WrongRemapRule,
    testing::Values(WrongRule{"from", "expected FROM:=TO"}, WrongRule{"from:to", "expected FROM:=TO"},
                    WrongRule{":=to", "nothing stands before ':='"}, WrongRule{"from:=", "nothing stands after ':='"},
                    WrongRule{"from:=a b", "'a b' is no valid name"}, WrongRule{"/:=to", "'/' is no valid name"},
                    WrongRule{"from:=to/", "'to/' is no valid name"}, WrongRule{"a//b:=c", "'a//b' is no valid name"},
                    WrongRule{"from:=1to", "'1to' is no valid name"},
                    WrongRule{"/*/from:=to", "wildcards are not supported, but '/*/from' has one"},
                    WrongRule{"from:=\\1", "back references are not supported, but '\\1' has one"},
                    WrongRule{"__node:=a/b", "'a/b' is no valid node name"},
                    WrongRule{"__node:=", "'' is no valid node name"},
                    WrongRule{"__ns:=a", "namespace 'a' must begin with a '/'"},
                    WrongRule{"__ns:=/a/", "'/a/' is no valid name"},
                    WrongRule{"/ns/talker:from:=to", "'/ns/talker' is no valid node name"}));

}  // namespace
