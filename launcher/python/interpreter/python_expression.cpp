// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/interpreter/python_expression.hpp"

#include "launcher/python/interpreter/python_module.hpp"

namespace launch {

std::string evaluate_python(const std::string& expression, const std::string& modules) {
  return python_runtime().evaluate(expression, modules);
}

}  // namespace launch
