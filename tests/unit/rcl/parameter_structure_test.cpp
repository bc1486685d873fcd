// SPDX-License-Identifier: Apache-2.0
// rcl_yaml_param_parser: parameter files as structures of C.
#include <gmock/gmock.h>
#include <rcl_yaml_param_parser/parser.h>
#include <rcutils/error_handling.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <span>

#include "rcl_test.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using rcl_test::take_error;
using testing::ElementsAre;

using Params = std::unique_ptr<rcl_params_t, void (*)(rcl_params_t*)>;

Params make_params(rcutils_allocator_t allocator = rcutils_get_default_allocator()) {
  return {rcl_yaml_node_struct_init(allocator), rcl_yaml_node_struct_fini};
}

std::vector<std::string> node_names(const rcl_params_t& params) {
  return {params.node_names, params.node_names + params.num_nodes};
}

std::vector<std::string> parameter_names(const rcl_node_params_t& node) {
  return {node.parameter_names, node.parameter_names + node.num_params};
}

// How many of the pointers of a value are set.
int values_set(const rcl_variant_t& v) {
  return (v.bool_value != nullptr) + (v.integer_value != nullptr) + (v.double_value != nullptr) +
         (v.string_value != nullptr) + (v.byte_array_value != nullptr) + (v.bool_array_value != nullptr) +
         (v.integer_array_value != nullptr) + (v.double_array_value != nullptr) + (v.string_array_value != nullptr);
}

class ParameterStructure : public testing::Test {
 protected:
  // Reads a file with this text. Returns the error without the name of the file, or an empty text.
  std::string read(const std::string& text) {
    const std::string file = write("parameters.yaml", text);
    if (rcl_parse_yaml_file(file.c_str(), params_.get())) {
      return "";
    }
    const std::string error = take_error();
    return error.starts_with(file + ":") ? error.substr(file.size() + 1) : error;
  }

  std::string write(const char* name, const std::string& text) const {
    const std::string file = (sandbox_.directory() / name).string();
    std::ofstream(file) << text;
    return file;
  }

  // The value that a text has as the value of a parameter.
  const rcl_variant_t& value(const std::string& text) {
    EXPECT_TRUE(rcl_parse_yaml_value("node", "x", text.c_str(), params_.get())) << text << ": " << take_error();
    const rcl_variant_t* result = rcl_yaml_node_struct_get("node", "x", params_.get());
    EXPECT_EQ(values_set(*result), 1) << text;
    return *result;
  }

  test_support::Sandbox sandbox_;
  Params params_ = make_params();
};

TEST_F(ParameterStructure, HasNodesAndNestedParametersInTheOrderOfTheFile) {
  ASSERT_EQ(read("---\n"
                 "lidar_ns:\n"
                 "  lidar_1:\n"
                 "    ros__parameters: {id: 10, driver: {dx: 4.5, on: true}, ports: [1, 2]}\n"
                 "  lidar_2:\n"
                 "    ros__parameters: {name: \"\"}\n"
                 "/**:\n"
                 "  ros__parameters: {}\n"
                 "---\n"
                 "camera: {ros__parameters: {brands: [Bosch, '7']}}\n"),
            "");
  EXPECT_THAT(node_names(*params_), ElementsAre("lidar_ns/lidar_1", "lidar_ns/lidar_2", "/**", "camera"));
  EXPECT_THAT(parameter_names(params_->params[0]), ElementsAre("id", "driver.dx", "driver.on", "ports"));
  EXPECT_EQ(params_->params[2].num_params, 0u);
  const rcl_variant_t* values = params_->params[0].parameter_values;
  EXPECT_EQ(*values[0].integer_value, 10);
  EXPECT_EQ(*values[1].double_value, 4.5);
  EXPECT_TRUE(*values[2].bool_value);
  EXPECT_THAT(std::span(values[3].integer_array_value->values, values[3].integer_array_value->size), ElementsAre(1, 2));
  EXPECT_STREQ(params_->params[1].parameter_values[0].string_value, "");
  const rcutils_string_array_t* brands = params_->params[3].parameter_values[0].string_array_value;
  EXPECT_THAT(std::span(brands->data, brands->size), ElementsAre(testing::StrEq("Bosch"), testing::StrEq("7")));
}

TEST_F(ParameterStructure, ALaterFileReplacesValuesAlsoByThoseOfAnotherType) {
  ASSERT_EQ(read("a: {ros__parameters: {x: 1, group: {y: 2}, z: [1]}}"), "");
  ASSERT_EQ(read("a: {ros__parameters: {x: text, group: {y: 3}, z: [true, false]}}"), "");
  EXPECT_THAT(parameter_names(params_->params[0]), ElementsAre("x", "group.y", "z"));
  const rcl_variant_t* values = params_->params[0].parameter_values;
  EXPECT_STREQ(values[0].string_value, "text");
  EXPECT_EQ(values_set(values[0]), 1);
  EXPECT_EQ(*values[1].integer_value, 3);
  EXPECT_THAT(std::span(values[2].bool_array_value->values, values[2].bool_array_value->size),
              ElementsAre(true, false));
}

TEST_F(ParameterStructure, ValuesHaveTheTypesOfRos) {
  EXPECT_TRUE(*value("on").bool_value);
  EXPECT_FALSE(*value("N").bool_value);
  EXPECT_EQ(*value("992147483647").integer_value, 992147483647);
  EXPECT_EQ(*value("0x1F").integer_value, 31);
  EXPECT_EQ(*value("08").double_value, 8.0);
  EXPECT_EQ(*value("-.Inf").double_value, -INFINITY);
  EXPECT_TRUE(std::isnan(*value(".NaN").double_value));
  for (const char* text : {".nAN", ".INf", "-.nan", "+.nan", ".infinity", "1e400", "tRUE", "null"}) {
    EXPECT_STREQ(value(text).string_value, text);
  }
  EXPECT_STREQ(value("'7'").string_value, "7");
  EXPECT_STREQ(value("!!str 7").string_value, "7");
  // Only quotes make a string of a number.
  EXPECT_EQ(*value("|-\n  7").integer_value, 7);
  EXPECT_STREQ(value("|\n  7\n").string_value, "7\n");
  const rcl_double_array_t* doubles = value("[1.5, .inf]").double_array_value;
  EXPECT_THAT(std::span(doubles->values, doubles->size), ElementsAre(1.5, INFINITY));
}

TEST_F(ParameterStructure, AnEmptyListAndACommentHaveNoValue) {
  for (const char* text : {"[]", "# nothing"}) {
    EXPECT_TRUE(rcl_parse_yaml_value("node", "x", text, params_.get())) << text;
    EXPECT_EQ(values_set(*rcl_yaml_node_struct_get("node", "x", params_.get())), 0) << text;
  }
  EXPECT_EQ(read("node: {ros__parameters: {x: []}}"), "");
}

TEST_F(ParameterStructure, NamesOfNodesMayHaveWildcardsForWholeLevels) {
  for (const std::string name : {"/**", "/*", "**", "*", "node", "/node", "ns/node", "/**/node", "/*/node", "/ns/**",
                                 "/ns/*/node", "/ns/**/bar/*"}) {
    EXPECT_EQ(read("\"" + name + "\": {ros__parameters: {x: 1}}"), "") << name;
  }
  EXPECT_EQ(read("/: {node: {ros__parameters: {x: 1}}}"), "");
  EXPECT_THAT(node_names(*params_), testing::Contains("/node"));
}

struct Refused {
  const char* text;
  const char* error;
};

class RefusedFile : public ParameterStructure, public testing::WithParamInterface<Refused> {};

TEST_P(RefusedFile, SaysWhereAndWhy) {
  EXPECT_EQ(read(GetParam().text), GetParam().error) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    Names, RefusedFile,
    testing::Values(Refused{"/foo**: {ros__parameters: {x: 1}}",
                            "1: '/foo**' is no name of a node: node name must not contain characters other than "
                            "letters, digits and '_'"},
                    Refused{"/f*o/node: {ros__parameters: {x: 1}}",
                            "1: '/f*o/node' is no name of a node: namespace must not contain characters other than "
                            "letters, digits, '_' and '/'"},
                    Refused{"/**/n*ode: {ros__parameters: {x: 1}}",
                            "1: '/**/n*ode' is no name of a node: node name must not contain characters other than "
                            "letters, digits and '_'"},
                    Refused{"ns//node: {ros__parameters: {x: 1}}",
                            "1: 'ns//node' is no name of a node: it has two slashes in a row"},
                    Refused{"/foo:\n  /*:\n    ros__parameters: {x: 1}",
                            "3: '/foo//*' is no name of a node: it has two slashes in a row"},
                    Refused{"/: {ros__parameters: {x: 1}}",
                            "1: '/' is no name of a node: node name must not be empty"}));
INSTANTIATE_TEST_SUITE_P(
    Nesting, RefusedFile,
    testing::Values(
        Refused{"a: {ros__parameters: {x: 1}}\nros__parameters: {x: 1}",
                "2: 'ros__parameters' must stand below a node name, such as '/**'"},
        Refused{"a:\n  ros__parameters:\n", "2: 'ros__parameters' must hold parameters as NAME: VALUE"},
        Refused{"a:\n  ros__parameters:\n    - x: 1", "3: 'ros__parameters' must hold parameters as NAME: VALUE"},
        Refused{"a: {ros__parameters: {x: 1}}\n---\n- b", "3: a parameter file must be a mapping of node names"},
        Refused{"a: {ros__parameters: {\"\": 1}}", "1: a parameter name must be a plain value"},
        Refused{"a: {ros__parameters: {x: {}, y: [{z: 1}]}}",
                "1: the list of parameter 'y' may only have plain values"},
        Refused{"a: 5",
                "1: 'a' stands where a node name is expected; parameters must stand below NODE: "
                "ros__parameters:"}));
INSTANTIATE_TEST_SUITE_P(
    Values, RefusedFile,
    testing::Values(
        Refused{"a: {ros__parameters: {x: }}", "1: parameter 'x' has no value; an empty string is written \"\""},
        Refused{"a: {ros__parameters: {x: !!str }}", "1: parameter 'x' has no value; an empty string is written \"\""},
        Refused{"a: {ros__parameters: {x: [1, 2.5]}}",
                "1: the list of parameter 'x' must be of one type, but begins with an integer and has a "
                "double"},
        Refused{"a: {ros__parameters: {x: &one 1, y: *one}}", "1: aliases (*name) are not supported"}));

TEST_F(ParameterStructure, ValuesThatAreNone) {
  rcl_params_t* params = params_.get();
  for (const char* text : {"{a: 1}", "*a", "[1, a]", "[[1]]", "'open", "[1] 2", "1\n---\n2"}) {
    EXPECT_FALSE(rcl_parse_yaml_value("node", "x", text, params)) << text;
    EXPECT_NE(take_error(), "") << text;
  }
  EXPECT_FALSE(rcl_parse_yaml_value("", "x", "1", params));
  EXPECT_FALSE(rcl_parse_yaml_value("node", "", "1", params));
  EXPECT_FALSE(rcl_parse_yaml_value("node", "x", "", params));
  EXPECT_EQ(take_error(), "");
  EXPECT_FALSE(rcl_parse_yaml_value(nullptr, "x", "1", params));
  EXPECT_EQ(take_error(), "node_name argument is null");
  EXPECT_FALSE(rcl_parse_yaml_value("node", "x", "1", nullptr));
  EXPECT_FALSE(rcl_parse_yaml_file(nullptr, params));
  EXPECT_EQ(take_error(), "YAML file path is NULL");
  EXPECT_FALSE(rcl_parse_yaml_file("/nowhere.yaml", params));
  EXPECT_EQ(take_error(), "parameter file '/nowhere.yaml' cannot be read: No such file or directory");
}

TEST_F(ParameterStructure, GrowsForManyNodesAndParameters) {
  for (int i = 0; i < 300; ++i) {
    const std::string name = "name_" + std::to_string(i);
    ASSERT_TRUE(rcl_parse_yaml_value(name.c_str(), "x", "1", params_.get()));
    ASSERT_TRUE(rcl_parse_yaml_value("node", name.c_str(), "[a, b]", params_.get()));
  }
  EXPECT_EQ(params_->num_nodes, 301u);
  EXPECT_EQ(params_->capacity_nodes, 512u);
  EXPECT_EQ(params_->params[1].num_params, 300u);
  EXPECT_STREQ(rcl_yaml_node_struct_get("node", "name_299", params_.get())->string_array_value->data[1], "b");
}

TEST_F(ParameterStructure, RoomIsAsAskedFor) {
  const rcutils_allocator_t allocator = rcutils_get_default_allocator();
  const Params one(rcl_yaml_node_struct_init_with_capacity(1, allocator), rcl_yaml_node_struct_fini);
  EXPECT_EQ(one->capacity_nodes, 1u);
  EXPECT_EQ(rcl_yaml_node_struct_reallocate(one.get(), 3, allocator), RCUTILS_RET_OK);
  EXPECT_EQ(one->capacity_nodes, 3u);
  ASSERT_TRUE(rcl_parse_yaml_value("a", "x", "1", one.get()));
  ASSERT_TRUE(rcl_parse_yaml_value("b", "x", "1", one.get()));
  EXPECT_EQ(rcl_yaml_node_struct_reallocate(one.get(), 1, allocator), RCUTILS_RET_INVALID_ARGUMENT);
  EXPECT_EQ(take_error(), "new capacity '1' must be greater than or equal to '2'");
  EXPECT_EQ(rcl_yaml_node_struct_init_with_capacity(0, allocator), nullptr);
  EXPECT_EQ(take_error(), "capacity can't be zero");
  EXPECT_EQ(rcl_yaml_node_struct_init(rcutils_get_zero_initialized_allocator()), nullptr);
  EXPECT_EQ(take_error(), "invalid allocator");
}

constexpr const char* kAllTypes =
    "node: {ros__parameters: {a: true, b: 1, c: 1.5, d: text, e: [true], f: [1], g: [1.5], h: [text, 'more'], i: []}}";

TEST_F(ParameterStructure, IsCopied) {
  ASSERT_EQ(read(kAllTypes), "");
  const Params copy(rcl_yaml_node_struct_copy(params_.get()), rcl_yaml_node_struct_fini);
  params_.reset();
  ASSERT_NE(copy, nullptr);
  EXPECT_THAT(node_names(*copy), ElementsAre("node"));
  const rcl_variant_t* values = copy->params[0].parameter_values;
  EXPECT_TRUE(*values[0].bool_value);
  EXPECT_EQ(*values[1].integer_value, 1);
  EXPECT_EQ(*values[2].double_value, 1.5);
  EXPECT_STREQ(values[3].string_value, "text");
  EXPECT_TRUE(values[4].bool_array_value->values[0]);
  EXPECT_EQ(values[5].integer_array_value->values[0], 1);
  EXPECT_EQ(values[6].double_array_value->values[0], 1.5);
  EXPECT_STREQ(values[7].string_array_value->data[1], "more");
  EXPECT_EQ(values_set(values[8]), 0);
  EXPECT_EQ(rcl_yaml_node_struct_copy(nullptr), nullptr);
  EXPECT_EQ(take_error(), "params_st argument is null");
}

// Memory that ends after some allocations, and is counted.
struct Budget {
  int left = 0;
  int in_use = 0;

  rcutils_allocator_t allocator() {
    rcutils_allocator_t result = rcutils_get_zero_initialized_allocator();
    result.state = this;
    result.allocate = [](size_t size, void* state) { return of(state).take(1, size); };
    result.zero_allocate = [](size_t count, size_t size, void* state) { return of(state).take(count, size); };
    result.reallocate = [](void* memory, size_t size, void* state) {
      return of(state).left-- > 0 ? std::realloc(memory, size) : nullptr;
    };
    result.deallocate = [](void* memory, void* state) {
      of(state).in_use -= memory != nullptr;
      std::free(memory);
    };
    return result;
  }

 private:
  static Budget& of(void* state) { return *static_cast<Budget*>(state); }
  void* take(size_t count, size_t size) {
    if (left-- <= 0) {
      return nullptr;
    }
    ++in_use;
    return std::calloc(count, size);
  }
};

TEST_F(ParameterStructure, NothingLeaksWhereverMemoryRunsOut) {
  const std::string file = write("all.yaml", kAllTypes);
  int failures = 0;
  for (int allowed = 0;; ++allowed) {
    Budget budget{allowed};
    bool complete = false;
    {
      const Params params = make_params(budget.allocator());
      if (params != nullptr && rcl_parse_yaml_file(file.c_str(), params.get())) {
        const Params copy(rcl_yaml_node_struct_copy(params.get()), rcl_yaml_node_struct_fini);
        complete = copy != nullptr;
      }
    }
    EXPECT_EQ(budget.in_use, 0) << "after " << allowed << " allocations";
    if (complete) {
      break;
    }
    ++failures;
    EXPECT_NE(take_error(), "");
  }
  EXPECT_GT(failures, 50);
}

TEST_F(ParameterStructure, IsPrinted) {
  ASSERT_EQ(read(kAllTypes), "");
  testing::internal::CaptureStdout();
  rcl_yaml_node_struct_print(nullptr);
  rcl_yaml_node_struct_print(params_.get());
  const std::string gap(49, ' ');
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "\n Node Name\t\t\t\tParameters\nnode\n" + gap + "a: true\n" + gap +
                                                        "b: 1\n" + gap + "c: 1.500000\n" + gap + "d: text\n" + gap +
                                                        "e: true, \n" + gap + "f: 1, \n" + gap + "g: 1.500000, \n" +
                                                        gap + "h: text, more, \n" + gap + "i: \n");
}

}  // namespace
