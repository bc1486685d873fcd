// SPDX-License-Identifier: Apache-2.0
#include "rcl_yaml_param_parser/parser.h"

#include <rcutils/error_handling.h>

#include <stdexcept>

#include "rcl_yaml_param_parser/read_yaml.hpp"
#include "structures.hpp"

namespace {

constexpr const char* kNoStructure = "Pass an initialized parameter structure";

// Puts what a file has into a structure.
class IntoStructure : public rcl_yaml::ParameterSink {
 public:
  explicit IntoStructure(rcl_params_t& params) : params_(params) {}

  void add_node(const std::string& node) override { node_ = rcl_yaml::find_node(params_, node); }

  void add_parameter(const std::string& name, std::optional<rcl_yaml::ParameterValue> value,
                     const std::string& /*place*/) override {
    rcl_yaml::set_variant(rcl_yaml::find_parameter(params_, node_, name), value, params_.allocator);
  }

 private:
  rcl_params_t& params_;
  std::size_t node_ = 0;
};

// Runs `body`. Returns false and sets the error if it throws.
template <typename BodyT>
bool succeeds(BodyT body) {
  try {
    body();
    return true;
  } catch (const std::exception& error) {
    RCUTILS_SET_ERROR_MSG(error.what());
    return false;
  }
}

}  // namespace

extern "C" {

bool rcl_parse_yaml_file(const char* file_path, rcl_params_t* params_st) {
  RCUTILS_CHECK_FOR_NULL_WITH_MSG(file_path, "YAML file path is NULL", return false);
  if (params_st == nullptr) {
    RCUTILS_SAFE_FWRITE_TO_STDERR(kNoStructure);
    return false;
  }
  return succeeds([&] {
    IntoStructure sink(*params_st);
    rcl_yaml::read_parameters(rcl_yaml::read_file(file_path), file_path, sink);
  });
}

bool rcl_parse_yaml_value(const char* node_name, const char* param_name, const char* yaml_value,
                          rcl_params_t* params_st) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_name, false);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(param_name, false);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(yaml_value, false);
  if (*node_name == '\0' || *param_name == '\0' || *yaml_value == '\0') {
    return false;
  }
  if (params_st == nullptr) {
    RCUTILS_SAFE_FWRITE_TO_STDERR(kNoStructure);
    return false;
  }
  return succeeds([&] {
    rcl_yaml::set_parameter(*params_st, node_name, param_name, rcl_yaml::read_value(yaml_value, param_name, false));
  });
}

rcl_variant_t* rcl_yaml_node_struct_get(const char* node_name, const char* param_name, rcl_params_t* params_st) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(node_name, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(param_name, nullptr);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(params_st, nullptr);
  rcl_variant_t* variant = nullptr;
  succeeds(
      [&] { variant = &rcl_yaml::find_parameter(*params_st, rcl_yaml::find_node(*params_st, node_name), param_name); });
  return variant;
}

}  // extern "C"
