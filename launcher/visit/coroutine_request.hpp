// SPDX-License-Identifier: Apache-2.0
// An OpaqueCoroutine of a Python launch file that has been visited: it is to run beside the processes.
#pragma once

#include <memory>

#include "launcher/base/source.hpp"
#include "launcher/python/interpreter/python_runtime.hpp"

namespace launch {

class PythonFile;

struct CoroutineRequest {
  python::ObjectPtr object;
  std::shared_ptr<PythonFile> file;
  SourceRange where;
};

}  // namespace launch
