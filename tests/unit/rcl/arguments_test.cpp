// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <ostream>

#include "rcl_test.hpp"

namespace {

using rcl_test::Arguments;

using Indices = std::vector<int>;

Indices unparsed(const Arguments& arguments) {
  int* indices = nullptr;
  EXPECT_EQ(rcl_arguments_get_unparsed(&arguments.handle, rcl_get_default_allocator(), &indices), RCL_RET_OK);
  const Indices result(indices, indices + rcl_arguments_get_count_unparsed(&arguments.handle));
  std::free(indices);
  return result;
}

Indices unparsed_ros(const Arguments& arguments) {
  int* indices = nullptr;
  EXPECT_EQ(rcl_arguments_get_unparsed_ros(&arguments.handle, rcl_get_default_allocator(), &indices), RCL_RET_OK);
  const Indices result(indices, indices + rcl_arguments_get_count_unparsed_ros(&arguments.handle));
  std::free(indices);
  return result;
}

TEST(Arguments, OutsideRosSectionsAreLeftToTheApplication) {
  const Arguments arguments({"program", "-x", "--ros-args", "-r", "a:=b", "--", "file", "--ros-args", "-p", "n:=1"});
  ASSERT_EQ(arguments.result, RCL_RET_OK) << arguments.error;
  EXPECT_EQ(unparsed(arguments), (Indices{0, 1, 6}));
  EXPECT_EQ(unparsed_ros(arguments), Indices{});
}

TEST(Arguments, UnknownOnesInsideRosSectionsAreKeptApart) {
  const Arguments arguments({"program", "--ros-args", "--nonsense", "value", "-r", "a:=b"});
  ASSERT_EQ(arguments.result, RCL_RET_OK) << arguments.error;
  EXPECT_EQ(unparsed(arguments), Indices{0});
  EXPECT_EQ(unparsed_ros(arguments), (Indices{2, 3}));
}

TEST(Arguments, AnEmptyRosSectionAndARepeatedFlagMeanNothing) {
  const Arguments arguments({"program", "--ros-args", "--ros-args"});
  ASSERT_EQ(arguments.result, RCL_RET_OK) << arguments.error;
  EXPECT_EQ(unparsed(arguments), Indices{0});
  EXPECT_EQ(unparsed_ros(arguments), Indices{});
}

TEST(Arguments, OfTheApplicationCanBeHadAsArgv) {
  const Arguments arguments({"program", "--ros-args", "-r", "a:=b", "--", "file"});
  int argc = 0;
  const char** argv = nullptr;
  ASSERT_EQ(rcl_remove_ros_arguments(arguments.argv(), &arguments.handle, rcl_get_default_allocator(), &argc, &argv),
            RCL_RET_OK);
  ASSERT_EQ(argc, 2);
  EXPECT_STREQ(argv[0], "program");
  EXPECT_STREQ(argv[1], "file");
  EXPECT_EQ(argv[2], nullptr);
  std::free(argv);
}

TEST(Arguments, TakeARemapRuleOfTheOldFormWithAWarning) {
  testing::internal::CaptureStderr();
  const Arguments arguments({"program", "from:=to"});
  const std::string output = testing::internal::GetCapturedStderr();
  ASSERT_EQ(arguments.result, RCL_RET_OK);
  EXPECT_EQ(unparsed(arguments), Indices{0});
  EXPECT_NE(output.find("[rcl]: remap rule 'from:=to' stands outside --ros-args, which is deprecated: write "
                        "'--ros-args -r from:=to'"),
            std::string::npos)
      << output;
}

TEST(Arguments, CanBeCopied) {
  const Arguments arguments({"program", "--ros-args", "-r", "__node:=renamed"});
  rcl_arguments_t copy = rcl_get_zero_initialized_arguments();
  ASSERT_EQ(rcl_arguments_copy(&arguments.handle, &copy), RCL_RET_OK);
  char* output = nullptr;
  ASSERT_EQ(rcl_remap_node_name(&copy, nullptr, "talker", rcl_get_default_allocator(), &output), RCL_RET_OK);
  EXPECT_EQ(rcl_test::take_string(output), "renamed");
  EXPECT_EQ(rcl_arguments_fini(&copy), RCL_RET_OK);
}

struct Wrong {
  std::vector<std::string> arguments;
  const char* message;
};

std::ostream& operator<<(std::ostream& out, const Wrong& wrong) {
  return out << wrong.message;
}

class WrongArguments : public testing::TestWithParam<Wrong> {};

TEST_P(WrongArguments, AreNamedWithTheReason) {
  std::vector<std::string> line{"program", "--ros-args"};
  line.insert(line.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  const Arguments arguments(line);
  EXPECT_EQ(arguments.result, RCL_RET_INVALID_ROS_ARGS);
  EXPECT_EQ(arguments.error, GetParam().message);
  EXPECT_EQ(arguments.handle.impl, nullptr);
}

INSTANTIATE_TEST_SUITE_P(
    Vectors, WrongArguments,
    testing::Values(
        Wrong{{"-r"}, "'-r' is the last argument, but a rule FROM:=TO must follow it"},
        Wrong{{"--params-file"}, "'--params-file' is the last argument, but a file name must follow it"},
        Wrong{{"--remap", "x"}, "'--remap x' is no remap rule: expected FROM:=TO"},
        Wrong{{"-p", "x"}, "'-p x' is no parameter: expected NAME:=VALUE"},
        Wrong{{"-p", ":=1"}, "'-p :=1' is no parameter: '' is no valid parameter name"},
        Wrong{{"--param", "x:="}, "'--param x:=' is no parameter: no value stands after ':='"},
        Wrong{{"-p", "x:=[1, a]"},
              "'-p x:=[1, a]' is no parameter: the list of parameter 'x' must be of one type, but begins with "
              "an integer and has a string"},
        Wrong{{"-p", "x:={a: 1}"}, "'-p x:={a: 1}' is no parameter: a mapping is no parameter value"},
        Wrong{{"-p", "a-b:x:=1"}, "'-p a-b:x:=1' is no parameter: 'a-b' is no valid node name"},
        Wrong{{"--params-file", "/no/such/file"},
              "'--params-file /no/such/file': parameter file '/no/such/file' cannot be read: No such file or "
              "directory"},
        Wrong{{"--log-level", "loud"},
              "'--log-level loud': 'loud' is no log level; use debug, info, warn, error, fatal or unset"},
        Wrong{{"--log-level", "a:=loud"},
              "'--log-level a:=loud': 'loud' is no log level; use debug, info, warn, error, fatal or unset"},
        Wrong{{"--log-level", ":=info"}, "'--log-level :=info': no logger name stands before ':='"},
        Wrong{{"-e", "x"}, "'-e x': an enclave must begin with a '/'"}));

}  // namespace
