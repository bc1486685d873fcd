// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace test_support {

// The text of the ExceptionT that `function` throws; "nothing" if it throws none.
template <typename ExceptionT, typename FunctionT>
std::string thrown_by(FunctionT function) {
  try {
    function();
  } catch (const ExceptionT& error) {
    return error.what();
  }
  return "nothing";
}

}  // namespace test_support
