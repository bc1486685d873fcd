// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/recorded_names.hpp"

#include <algorithm>
#include <iterator>

namespace tracing::twin {

namespace {

constexpr const char* kOwnServices[] = {"/describe_parameters", "/get_parameter_types", "/get_parameters",
                                        "/list_parameters",     "/set_parameters",      "/set_parameters_atomically",
                                        "/get_type_description"};

}  // namespace

bool is_own_service(const std::string& name) {
  return std::any_of(std::begin(kOwnServices), std::end(kOwnServices),
                     [&](const char* end) { return name.ends_with(end); });
}

bool is_of_action(const std::string& name) {
  return name.find("/_action/") != std::string::npos;
}

bool is_hidden(const std::string& name) {
  return name.find("/_") != std::string::npos;
}

bool is_own_topic(const std::string& name) {
  return name == "/rosout" || name == "/parameter_events" || name == "/clock";
}

}  // namespace tracing::twin
