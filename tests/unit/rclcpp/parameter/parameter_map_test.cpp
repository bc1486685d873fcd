// SPDX-License-Identifier: Apache-2.0
// Parameters from structures of C.
#include <gtest/gtest.h>
#include <rcl_yaml_param_parser/parser.h>

#include <functional>
#include <memory>
#include <rclcpp/parameter_map.hpp>

namespace {

using rclcpp::Parameter;
using rclcpp::ParameterMap;
using rclcpp::exceptions::InvalidParametersException;
using rclcpp::exceptions::InvalidParameterValueException;

class ParameterStructures : public testing::Test {
 protected:
  void set(const char* node, const char* name, const char* value) {
    ASSERT_TRUE(rcl_parse_yaml_value(node, name, value, params_.get()));
  }

  std::unique_ptr<rcl_params_t, void (*)(rcl_params_t*)> params_{
      rcl_yaml_node_struct_init(rcutils_get_default_allocator()), rcl_yaml_node_struct_fini};
};

template <typename ExceptionT>
std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const ExceptionT& error) {
    return error.what();
  }
  return "no exception";
}

TEST_F(ParameterStructures, BecomeAMapByNode) {
  set("a", "bool", "true");
  set("a", "integer", "7");
  set("a", "double", "1.5");
  set("a", "string", "text");
  set("/ns/b", "bools", "[true, false]");
  set("/ns/b", "integers", "[1, 2]");
  set("/ns/b", "doubles", "[.5]");
  set("/ns/b", "strings", "[x, z]");
  const ParameterMap map = rclcpp::parameter_map_from(params_.get());
  EXPECT_EQ(map.size(), 2u);
  EXPECT_EQ(map.at("/a"), (std::vector<Parameter>{Parameter("bool", true), Parameter("integer", 7),
                                                  Parameter("double", 1.5), Parameter("string", "text")}));
  EXPECT_EQ(map.at("/ns/b"), (std::vector<Parameter>{Parameter("bools", std::vector<bool>{true, false}),
                                                     Parameter("integers", std::vector<int64_t>{1, 2}),
                                                     Parameter("doubles", std::vector<double>{0.5}),
                                                     Parameter("strings", std::vector<std::string>{"x", "z"})}));
}

TEST_F(ParameterStructures, OfOneNodeAreThoseThatApplyToIt) {
  set("/**", "x", "1");
  set("/ns/node", "x", "2");
  set("other", "x", "[]");
  const ParameterMap map = rclcpp::parameter_map_from(params_.get(), "/ns/node");
  EXPECT_EQ(map.size(), 1u);
  EXPECT_EQ(map.at("/ns/node"), (std::vector<Parameter>{Parameter("x", 1), Parameter("x", 2)}));
  EXPECT_EQ(message_of<InvalidParameterValueException>([&] { (void)rclcpp::parameter_map_from(params_.get()); }),
            "No parameter value set: 'x'");
}

TEST_F(ParameterStructures, MayHaveBytes) {
  uint8_t values[] = {1, 255};
  rcl_byte_array_t bytes{values, 2};
  rcl_variant_t variant{};
  variant.byte_array_value = &bytes;
  EXPECT_EQ(rclcpp::parameter_value_from(&variant), rclcpp::ParameterValue(std::vector<uint8_t>{1, 255}));
}

TEST_F(ParameterStructures, ThatAreIncompleteAreRefused) {
  EXPECT_EQ(message_of<InvalidParameterValueException>([] { (void)rclcpp::parameter_value_from(nullptr); }),
            "Passed argument is NULL");
  const rcl_variant_t empty{};
  EXPECT_EQ(message_of<InvalidParameterValueException>([&] { (void)rclcpp::parameter_value_from(&empty); }),
            "No parameter value set");
  const auto refusal = [](const rcl_params_t* params) {
    return message_of<InvalidParametersException>([params] { (void)rclcpp::parameter_map_from(params); });
  };
  EXPECT_EQ(refusal(nullptr), "parameters struct is NULL");
  set("a", "x", "1");
  rcl_params_t params = *params_;
  params.node_names = nullptr;
  EXPECT_EQ(refusal(&params), "node names array is NULL");
  params = *params_;
  params.params = nullptr;
  EXPECT_EQ(refusal(&params), "node params array is NULL");
  char* no_name = nullptr;
  params = *params_;
  params.node_names = &no_name;
  EXPECT_EQ(refusal(&params), "Node name at index 0 is NULL");
  rcl_node_params_t node = params_->params[0];
  node.parameter_names = &no_name;
  params = *params_;
  params.params = &node;
  EXPECT_EQ(refusal(&params), "At node 0 parameter 0 name is NULL");
}

}  // namespace
