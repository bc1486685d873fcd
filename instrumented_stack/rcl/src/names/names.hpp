// SPDX-License-Identifier: Apache-2.0
// Names of topics and services: expansion and checks, as values and exceptions.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "rcl/types.h"

namespace rcl {

// An invalid name, with the code that the C interface returns for it.
class NameError : public std::invalid_argument {
 public:
  NameError(rcl_ret_t code, const std::string& message) : std::invalid_argument(message), code_(code) {}
  rcl_ret_t code() const { return code_; }

 private:
  rcl_ret_t code_;
};

// Expands the name but does not check the result. Throws NameError.
std::string expand_topic_name(std::string_view name, std::string_view node_name, std::string_view node_namespace);

// Throws NameError unless `name` is a full topic name.
void check_full_topic_name(const std::string& name);

// `/node` or `/ns/node`
std::string fully_qualified_name(std::string_view node_namespace, std::string_view node_name);

}  // namespace rcl
