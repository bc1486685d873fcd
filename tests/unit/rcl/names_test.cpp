// SPDX-License-Identifier: Apache-2.0
#include "rcl_test.hpp"

namespace {

using rcl_test::take_error;
using rcl_test::take_string;

const rcutils_string_map_t kNoMore = rcutils_get_zero_initialized_string_map();

struct Expansion {
  const char* input;
  const char* expected;
};

class ExpandTopicName : public testing::TestWithParam<Expansion> {};

TEST_P(ExpandTopicName, GivesTheFullNameForNodeTalkerInNamespaceNs) {
  char* output = nullptr;
  EXPECT_EQ(rcl_expand_topic_name(GetParam().input, "talker", "/ns", &kNoMore, rcl_get_default_allocator(), &output),
            RCL_RET_OK)
      << take_error();
  EXPECT_EQ(take_string(output), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Vectors, ExpandTopicName,
                         testing::Values(Expansion{"chatter", "/ns/chatter"}, Expansion{"a/b", "/ns/a/b"},
                                         Expansion{"/chatter", "/chatter"}, Expansion{"/a/b", "/a/b"},
                                         Expansion{"~", "/ns/talker"}, Expansion{"~/chatter", "/ns/talker/chatter"},
                                         Expansion{"{node}", "/ns/talker"}, Expansion{"{ns}", "/ns"},
                                         Expansion{"{namespace}/x", "/ns/x"}, Expansion{"/x{ns}", "/x/ns"},
                                         Expansion{"{node}/{node}", "/ns/talker/talker"},
                                         Expansion{"~/{node}_x", "/ns/talker/talker_x"},
                                         Expansion{"_hidden", "/ns/_hidden"}));

TEST(ExpandTopicNameInRoot, HasNoDoubleSlash) {
  char* output = nullptr;
  ASSERT_EQ(rcl_expand_topic_name("chatter", "talker", "/", &kNoMore, rcl_get_default_allocator(), &output),
            RCL_RET_OK);
  EXPECT_EQ(take_string(output), "/chatter");
  ASSERT_EQ(rcl_expand_topic_name("~/x", "talker", "/", &kNoMore, rcl_get_default_allocator(), &output), RCL_RET_OK);
  EXPECT_EQ(take_string(output), "/talker/x");
}

TEST(ExpandTopicName, NamesAnUnknownSubstitution) {
  char* output = nullptr;
  EXPECT_EQ(rcl_expand_topic_name("{nod}/x", "talker", "/ns", &kNoMore, rcl_get_default_allocator(), &output),
            RCL_RET_UNKNOWN_SUBSTITUTION);
  EXPECT_EQ(take_error(), "unknown substitution '{nod}' in topic name: it may be {node}, {ns} or {namespace}");
  EXPECT_EQ(output, nullptr);
}

TEST(ExpandTopicName, ReplacesWhatTheCallerKnows) {
  rcutils_string_map_t map = rcutils_get_zero_initialized_string_map();
  ASSERT_EQ(rcutils_string_map_init(&map, 0, rcl_get_default_allocator()), RCUTILS_RET_OK);
  ASSERT_EQ(rcl_get_default_topic_name_substitutions(&map), RCL_RET_OK);
  size_t size = 99;
  ASSERT_EQ(rcutils_string_map_get_size(&map, &size), RCUTILS_RET_OK);
  EXPECT_EQ(size, 0u);
  ASSERT_EQ(rcutils_string_map_set(&map, "robot", "arm"), RCUTILS_RET_OK);
  char* output = nullptr;
  EXPECT_EQ(rcl_expand_topic_name("{robot}/{node}/x", "talker", "/ns", &map, rcl_get_default_allocator(), &output),
            RCL_RET_OK);
  EXPECT_EQ(take_string(output), "/ns/arm/talker/x");
  EXPECT_EQ(rcutils_string_map_fini(&map), RCUTILS_RET_OK);
}

TEST(ExpandTopicName, ChecksTheNamesOfTheNode) {
  char* output = nullptr;
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  EXPECT_EQ(rcl_expand_topic_name("x", "a b", "/ns", &kNoMore, allocator, &output), RCL_RET_NODE_INVALID_NAME);
  EXPECT_EQ(take_error(),
            "invalid node name 'a b': node name must not contain characters other than letters, digits and '_'");
  EXPECT_EQ(rcl_expand_topic_name("x", "talker", "ns", &kNoMore, allocator, &output), RCL_RET_NODE_INVALID_NAMESPACE);
  EXPECT_EQ(take_error(), "invalid namespace 'ns': namespace must be absolute: it must begin with a '/'");
  EXPECT_EQ(rcl_expand_topic_name("x", "talker", "/ns", nullptr, allocator, &output), RCL_RET_INVALID_ARGUMENT);
  rcl_reset_error();
  EXPECT_EQ(output, nullptr);
}

struct Invalid {
  const char* name;
  int result;
  size_t index;
  const char* message;
};

class InvalidTopicName : public testing::TestWithParam<Invalid> {};

TEST_P(InvalidTopicName, IsRefusedWithTheReasonAndPlace) {
  int result = RCL_TOPIC_NAME_VALID;
  size_t index = 99;
  ASSERT_EQ(rcl_validate_topic_name(GetParam().name, &result, &index), RCL_RET_OK);
  EXPECT_EQ(result, GetParam().result);
  EXPECT_EQ(index, GetParam().index);
  char* output = nullptr;
  EXPECT_EQ(rcl_expand_topic_name(GetParam().name, "talker", "/ns", &kNoMore, rcl_get_default_allocator(), &output),
            RCL_RET_TOPIC_NAME_INVALID);
  EXPECT_EQ(take_error(), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Vectors, InvalidTopicName,
    testing::Values(
        Invalid{"", RCL_TOPIC_NAME_INVALID_IS_EMPTY_STRING, 0,
                "invalid topic name '', at character 1: topic name must not be empty"},
        Invalid{"a/", RCL_TOPIC_NAME_INVALID_ENDS_WITH_FORWARD_SLASH, 1,
                "invalid topic name 'a/', at character 2: topic name must not end with a '/'"},
        Invalid{"a b", RCL_TOPIC_NAME_INVALID_CONTAINS_UNALLOWED_CHARACTERS, 1,
                "invalid topic name 'a b', at character 2: topic name must not contain characters other than letters, "
                "digits, '_', '/', '~', "
                "'{' and '}'"},
        Invalid{"1a", RCL_TOPIC_NAME_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER, 0,
                "invalid topic name '1a', at character 1: a part of a topic name must not start with a number"},
        Invalid{"a/1b", RCL_TOPIC_NAME_INVALID_NAME_TOKEN_STARTS_WITH_NUMBER, 2,
                "invalid topic name 'a/1b', at character 3: a part of a topic name must not start with a number"},
        Invalid{"a{ns", RCL_TOPIC_NAME_INVALID_UNMATCHED_CURLY_BRACE, 1,
                "invalid topic name 'a{ns', at character 2: topic name has a curly brace without its counterpart"},
        Invalid{"ns}", RCL_TOPIC_NAME_INVALID_UNMATCHED_CURLY_BRACE, 2,
                "invalid topic name 'ns}', at character 3: topic name has a curly brace without its counterpart"},
        Invalid{"a~", RCL_TOPIC_NAME_INVALID_MISPLACED_TILDE, 1,
                "invalid topic name 'a~', at character 2: a '~' may only be the first character of a topic name"},
        Invalid{"~a", RCL_TOPIC_NAME_INVALID_TILDE_NOT_FOLLOWED_BY_FORWARD_SLASH, 1,
                "invalid topic name '~a', at character 2: a '~' must be followed by a '/'"},
        Invalid{"{a-b}", RCL_TOPIC_NAME_INVALID_SUBSTITUTION_CONTAINS_UNALLOWED_CHARACTERS, 2,
                "invalid topic name '{a-b}', at character 3: a substitution must not contain characters other than "
                "letters, digits and '_'"},
        Invalid{"{1a}", RCL_TOPIC_NAME_INVALID_SUBSTITUTION_STARTS_WITH_NUMBER, 1,
                "invalid topic name '{1a}', at character 2: a substitution must not start with a number"}));

}  // namespace
