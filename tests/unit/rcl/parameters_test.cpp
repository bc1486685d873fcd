// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "rcl/parameter_overrides.hpp"
#include "rcl_test.hpp"
#include "rcl_yaml_param_parser/parser.h"

namespace {

using rcl::ParameterOverrides;
using rcl::ParameterValue;
using rcl_test::Arguments;
using testing::ElementsAre;
using testing::Pair;

struct Typed {
  const char* text;
  ParameterValue expected;
};

std::ostream& operator<<(std::ostream& out, const Typed& typed) {
  return out << typed.text;
}

class ParameterText : public testing::TestWithParam<Typed> {};

TEST_P(ParameterText, HasTheTypeThatRosGivesIt) {
  ParameterOverrides overrides;
  overrides.set_from_text("/**", "x", GetParam().text);
  EXPECT_THAT(overrides.for_node("/talker"), ElementsAre(Pair("x", GetParam().expected)));
}

INSTANTIATE_TEST_SUITE_P(Bool, ParameterText,
                         testing::Values(Typed{"true", true}, Typed{"True", true}, Typed{"yes", true},
                                         Typed{"on", true}, Typed{"y", true}, Typed{"Y", true}, Typed{"false", false},
                                         Typed{"No", false}, Typed{"OFF", false}, Typed{"n", false}));
INSTANTIATE_TEST_SUITE_P(Integer, ParameterText,
                         testing::Values(Typed{"1", std::int64_t{1}}, Typed{"-7", std::int64_t{-7}},
                                         Typed{"+7", std::int64_t{7}}, Typed{"0x1F", std::int64_t{31}},
                                         Typed{"010", std::int64_t{8}}, Typed{"0", std::int64_t{0}},
                                         Typed{"9223372036854775807", std::numeric_limits<std::int64_t>::max()}));
INSTANTIATE_TEST_SUITE_P(Double, ParameterText,
                         testing::Values(Typed{"1.0", 1.0}, Typed{"1e3", 1000.0}, Typed{".5", 0.5},
                                         Typed{"inf", std::numeric_limits<double>::infinity()},
                                         Typed{".inf", std::numeric_limits<double>::infinity()},
                                         Typed{"-.inf", -std::numeric_limits<double>::infinity()},
                                         Typed{"9223372036854775808", 9223372036854775808.0}));
INSTANTIATE_TEST_SUITE_P(String, ParameterText,
                         testing::Values(Typed{"hello", "hello"}, Typed{"'1'", "1"}, Typed{"\"true\"", "true"},
                                         Typed{"''", ""}, Typed{"null", "null"}, Typed{"~", "~"}, Typed{"1:30", "1:30"},
                                         Typed{"2024-01-01", "2024-01-01"}, Typed{"!!str 5", "5"},
                                         Typed{"1_000", "1_000"}, Typed{"tRUE", "tRUE"}, Typed{"a b c", "a b c"}));
INSTANTIATE_TEST_SUITE_P(Tag, ParameterText,
                         testing::Values(Typed{"!!bool yes", true}, Typed{"!!bool 'off'", false},
                                         Typed{"!!int 0x10", std::int64_t{16}}, Typed{"!!int '7'", std::int64_t{7}},
                                         Typed{"!!float 10", 10.0}, Typed{"!!float \"2.5\"", 2.5},
                                         Typed{"!!float inf", std::numeric_limits<double>::infinity()},
                                         Typed{"!!str true", "true"}, Typed{"! 5", std::int64_t{5}},
                                         Typed{"!!binary AQID", std::vector<std::uint8_t>{1, 2, 3}},
                                         Typed{"!!binary '/+8='", std::vector<std::uint8_t>{0xff, 0xef}},
                                         Typed{"!!binary ''", std::vector<std::uint8_t>{}}));
INSTANTIATE_TEST_SUITE_P(TaggedList, ParameterText,
                         testing::Values(Typed{"[!!float 1, 2.5]", std::vector<double>{1.0, 2.5}},
                                         Typed{"!!seq [10, 0, -10]", std::vector<std::int64_t>{10, 0, -10}},
                                         Typed{"[!!str 1, !!str yes]", std::vector<std::string>{"1", "yes"}},
                                         Typed{"[!!binary AQ==, !!binary Aw==]", std::vector<std::uint8_t>{1, 3}}));
INSTANTIATE_TEST_SUITE_P(List, ParameterText,
                         testing::Values(Typed{"[1, 2]", std::vector<std::int64_t>{1, 2}},
                                         Typed{"[1.5, .2]", std::vector<double>{1.5, 0.2}},
                                         Typed{"[yes, off]", std::vector<bool>{true, false}},
                                         Typed{"[a, '1']", std::vector<std::string>{"a", "1"}}));

TEST(ParameterText, NanIsADouble) {
  ParameterOverrides overrides;
  overrides.set_from_text("/**", "x", ".nan");
  const auto values = overrides.for_node("/talker");
  EXPECT_NE(std::get<double>(values.at("x")), std::get<double>(values.at("x")));
}

struct Pattern {
  const char* pattern;
  const char* node;
  bool matches;
};

std::ostream& operator<<(std::ostream& out, const Pattern& p) {
  return out << p.pattern << " on " << p.node;
}

class NodePattern : public testing::TestWithParam<Pattern> {};

TEST_P(NodePattern, MatchesFullNames) {
  ParameterOverrides overrides;
  overrides.set(GetParam().pattern, "x", true);
  EXPECT_EQ(overrides.for_node(GetParam().node).size(), GetParam().matches ? 1u : 0u);
}

INSTANTIATE_TEST_SUITE_P(Vectors, NodePattern,
                         testing::Values(Pattern{"/**", "/talker", true}, Pattern{"/**", "/a/b/talker", true},
                                         Pattern{"/talker", "/talker", true}, Pattern{"talker", "/talker", true},
                                         Pattern{"talker", "/ns/talker", false},
                                         Pattern{"/ns/talker", "/ns/talker", true},
                                         Pattern{"/ns/talker", "/talker", false}, Pattern{"/*", "/talker", true},
                                         Pattern{"/*", "/ns/talker", false}, Pattern{"/*/talker", "/ns/talker", true},
                                         Pattern{"/*/talker", "/talker", false}, Pattern{"/**/talker", "/talker", true},
                                         Pattern{"/**/talker", "/a/b/talker", true},
                                         Pattern{"/**/talker", "/a/b/listener", false},
                                         Pattern{"/ns/**", "/ns/a/b", true}, Pattern{"/ns/**", "/other/a", false},
                                         Pattern{"/ns/*/x", "/ns/a/x", true}, Pattern{"/ns/*/x", "/ns/a/b/x", false},
                                         Pattern{"/**/a/*", "/x/a/b", true}, Pattern{"/talk", "/talker", false}));

// A file that is removed at the end of the test.
class ParameterFile : public testing::Test {
 protected:
  ParameterFile() {
    std::string path = (std::filesystem::temp_directory_path() / "parameters-XXXXXX").string();
    const int descriptor = mkstemp(path.data());
    EXPECT_NE(descriptor, -1);
    close(descriptor);
    path_ = path;
  }
  ~ParameterFile() override { std::filesystem::remove(path_); }

  void write(const std::string& text) { std::ofstream(path_) << text; }

  // The error without the name of the file.
  std::string load_error() {
    ParameterOverrides overrides;
    try {
      overrides.load_file(path_);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).substr(path_.size());
    }
    return "no error";
  }

  std::string path_;
};

TEST_F(ParameterFile, NestsNodesAndParameters) {
  write(R"(
/**:
  ros__parameters:
    everywhere: 1
ns:
  talker:
    ros__parameters:
      rate: 10.0
      qos:
        depth: 5
        names: [a, b]
)");
  ParameterOverrides overrides;
  overrides.load_file(path_);
  EXPECT_THAT(overrides.for_node("/ns/talker"),
              ElementsAre(Pair("everywhere", ParameterValue(std::int64_t{1})),
                          Pair("qos.depth", ParameterValue(std::int64_t{5})),
                          Pair("qos.names", ParameterValue(std::vector<std::string>{"a", "b"})),
                          Pair("rate", ParameterValue(10.0))));
  EXPECT_EQ(overrides.for_node("/talker").size(), 1u);
}

TEST_F(ParameterFile, MayBeEmptyOrHaveNoParameters) {
  ParameterOverrides overrides;
  write("");
  overrides.load_file(path_);
  write("---\n/**:\n  ros__parameters: {}\n---\ntalker:\n  ros__parameters: {}\n");
  overrides.load_file(path_);
  write("/**:\n  ros__parameters: {}\n");
  overrides.load_file(path_);
  EXPECT_TRUE(overrides.empty());
}

TEST_F(ParameterFile, LaterValuesWinButPatternsKeepTheirFirstPlace) {
  write("/**: {ros__parameters: {x: file, y: file}}");
  const Arguments arguments({"program", "--ros-args", "-p", "talker:x:=node", "-p", "x:=all", "--params-file", path_});
  ASSERT_EQ(arguments.result, RCL_RET_OK) << arguments.error;
  // "/talker" came first, so every value of "/**" is applied on top of it.
  EXPECT_THAT(rcl::parameter_overrides(arguments.handle).for_node("/talker"),
              ElementsAre(Pair("x", ParameterValue("file")), Pair("y", ParameterValue("file"))));

  const Arguments reversed({"program", "--ros-args", "--params-file", path_, "-p", "talker:x:=node", "-p", "y:=all"});
  EXPECT_THAT(rcl::parameter_overrides(reversed.handle).for_node("/talker"),
              ElementsAre(Pair("x", ParameterValue("node")), Pair("y", ParameterValue("all"))));
}

TEST_F(ParameterFile, IsToldToProgramsInC) {
  write("/**: {ros__parameters: {x: [1, 2], none: []}}");
  const Arguments arguments({"program", "--ros-args", "--params-file", path_, "-p", "talker:x:=node"});
  ASSERT_EQ(rcl_arguments_get_param_files_count(&arguments.handle), 1);
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  char** files = nullptr;
  ASSERT_EQ(rcl_arguments_get_param_files(&arguments.handle, allocator, &files), RCL_RET_OK);
  EXPECT_EQ(files[0], path_);
  allocator.deallocate(files[0], allocator.state);
  allocator.deallocate(files, allocator.state);

  rcl_params_t* params = nullptr;
  ASSERT_EQ(rcl_arguments_get_param_overrides(&arguments.handle, &params), RCL_RET_OK);
  ASSERT_EQ(params->num_nodes, 2u);
  EXPECT_STREQ(params->node_names[0], "/**");
  EXPECT_EQ(rcl_yaml_node_struct_get("/**", "x", params)->integer_array_value->values[1], 2);
  EXPECT_STREQ(params->params[0].parameter_names[1], "none");
  EXPECT_STREQ(rcl_yaml_node_struct_get("/talker", "x", params)->string_value, "node");
  EXPECT_EQ(rcl_arguments_get_param_overrides(&arguments.handle, &params), RCL_RET_INVALID_ARGUMENT);
  EXPECT_EQ(rcl_test::take_error(), "Output parameter override pointer is not null. May leak memory.");
  rcl_yaml_node_struct_fini(params);

  const Arguments none({"program"});
  params = nullptr;
  EXPECT_EQ(rcl_arguments_get_param_overrides(&none.handle, &params), RCL_RET_OK);
  EXPECT_EQ(params, nullptr);
  EXPECT_EQ(rcl_arguments_get_param_files_count(&none.handle), 0);
  const rcl_arguments_t never_parsed = rcl_get_zero_initialized_arguments();
  EXPECT_EQ(rcl_arguments_get_param_files_count(&never_parsed), -1);
  EXPECT_EQ(rcl_arguments_get_param_overrides(&never_parsed, &params), RCL_RET_INVALID_ARGUMENT);
  rcl_reset_error();
}

TEST_F(ParameterFile, NamesTheLineOfAnError) {
  write("talker:\n  ros__parameters:\n    x:\n");
  EXPECT_EQ(load_error(), ":3: parameter 'x' has no value; an empty string is written \"\"");
  write("talker:\n  ros__parameters:\n    x: [1, 2.5]\n");
  EXPECT_EQ(load_error(),
            ":3: the list of parameter 'x' must be of one type, but begins with an integer and has a double");
  write("talker:\n  ros__parameters:\n    x: [[1]]\n");
  EXPECT_EQ(load_error(), ":3: the list of parameter 'x' may only have plain values");
  write("talker:\n  ros__parameters:\n");
  EXPECT_EQ(load_error(), ":2: 'ros__parameters' must hold parameters as NAME: VALUE");
  write("talker:\n  rate: 5\n");
  EXPECT_EQ(load_error(),
            ":2: 'rate' stands where a node name is expected; parameters must stand below NODE: ros__parameters:");
  write("ros__parameters:\n  x: 1\n");
  EXPECT_EQ(load_error(), ":1: 'ros__parameters' must stand below a node name, such as '/**'");
  write("talker:\n  ros__parameters: 5\n");
  EXPECT_EQ(load_error(), ":2: 'ros__parameters' must hold parameters as NAME: VALUE");
  write("- a\n- b\n");
  EXPECT_EQ(load_error(), ":1: a parameter file must be a mapping of node names");
  write("talker:\n  ros__parameters: &a\n    x: 1\nlistener: *a\n");
  EXPECT_EQ(load_error(), ":4: aliases (*name) are not supported");
  write("talker:\n  ros__parameters:\n    x: 'open\n");
  EXPECT_EQ(load_error(), ":4: found unexpected end of stream");
}

TEST_F(ParameterFile, SaysWhichValueDoesNotFitItsTag) {
  write("talker:\n  ros__parameters:\n    x: !!int abc\n");
  EXPECT_EQ(load_error(), ":3: parameter 'x': 'abc' is no integer, as the tag !!int says");
  write("talker:\n  ros__parameters:\n    x: !!bool 1\n");
  EXPECT_EQ(load_error(), ":3: parameter 'x': '1' is no bool, as the tag !!bool says");
  write("talker:\n  ros__parameters:\n    x: [1.5, !!float a]\n");
  EXPECT_EQ(load_error(), ":3: parameter 'x': 'a' is no double, as the tag !!float says");
  for (const char* text : {"AQI", "AQ=A", "A===", "A*ID", "="}) {
    write(std::string("talker:\n  ros__parameters:\n    x: !!binary ") + text + "\n");
    EXPECT_EQ(load_error(), std::string(":3: parameter 'x': '") + text + "' is no base64, as the tag !!binary says");
  }
  write("talker:\n  ros__parameters:\n    x: !!timestamp 2026-01-01\n");
  EXPECT_EQ(load_error(),
            ":3: parameter 'x': the tag '!!timestamp' is not one of !!bool, !!int, !!float, !!str, !!binary");
  write("talker:\n  ros__parameters:\n    x: !degrees 90\n");
  EXPECT_EQ(load_error(),
            ":3: parameter 'x': the tag '!degrees' is not one of !!bool, !!int, !!float, !!str, !!binary");
  write("talker:\n  ros__parameters:\n    x: !!map [1]\n");
  EXPECT_EQ(load_error(), ":3: the tag 'tag:yaml.org,2002:map' does not fit a list");
  write("talker:\n  ros__parameters:\n    x: !!seq {a: 1}\n");
  EXPECT_EQ(load_error(), ":3: the tag 'tag:yaml.org,2002:seq' does not fit a mapping");
}

TEST_F(ParameterFile, AnEmptyListIsWrongOnlyForANodeThatGetsIt) {
  write("talker:\n  ros__parameters:\n    x: []\nlistener:\n  ros__parameters:\n    y: 1\n");
  ParameterOverrides overrides;
  overrides.load_file(path_);
  EXPECT_THAT(overrides.for_node("/listener"), ElementsAre(Pair("y", ParameterValue(std::int64_t{1}))));
  try {
    (void)overrides.for_node("/talker");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(), path_ + ":3: parameter 'x' is an empty list, which has no type");
  }
  overrides.set_from_text("talker", "x", "[1]");
  EXPECT_EQ(overrides.for_node("/talker").size(), 1u);
}

TEST_F(ParameterFile, ChangesNothingWhenItIsWrong) {
  write("talker: {ros__parameters: {x: 1, y: [1, a]}}");
  ParameterOverrides overrides;
  EXPECT_THROW(overrides.load_file(path_), std::invalid_argument);
  EXPECT_TRUE(overrides.empty());
}

TEST(ParameterOverrides, OfADirectoryCannotBeRead) {
  ParameterOverrides overrides;
  try {
    overrides.load_file("/");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "parameter file '/' cannot be read: Is a directory");
  }
}

// As the libraries of user interfaces set it: 1.5 is written 1,5.
TEST_F(ParameterFile, IsReadTheSameWithALocaleOfDecimalCommas) {
  const std::string locales = path_ + ".locales";
  std::filesystem::create_directory(locales);
  const std::string command = "localedef -i de_DE -f UTF-8 " + locales + "/de_DE.UTF-8 > /dev/null 2>&1";
  if (std::system(command.c_str()) != 0) {
    std::filesystem::remove_all(locales);
    GTEST_SKIP() << "skipped, because this machine has no sources of locales";
  }
  setenv("LOCPATH", locales.c_str(), 1);
  ASSERT_NE(std::setlocale(LC_ALL, "de_DE.UTF-8"), nullptr);
  std::filesystem::remove_all(locales);
  EXPECT_EQ(std::strtod("1.5", nullptr), 1.0);
  write("talker: {ros__parameters: {x: 1.5, y: [0.25, 1.0e-3]}}");
  ParameterOverrides overrides;
  overrides.load_file(path_);
  std::setlocale(LC_ALL, "C");
  unsetenv("LOCPATH");
  EXPECT_THAT(overrides.for_node("/talker"),
              ElementsAre(Pair("x", ParameterValue(1.5)), Pair("y", ParameterValue(std::vector<double>{0.25, 0.001}))));
}

}  // namespace
