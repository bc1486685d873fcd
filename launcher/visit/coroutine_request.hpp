// SPDX-License-Identifier: Apache-2.0
// A visited OpaqueCoroutine of a Python launch file. It should run beside the processes.
#pragma once

#include <memory>

#include "base/diagnostics/source.hpp"
#include "launcher/python/interpreter/python_runtime.hpp"

namespace launch {

class PythonFile;

struct CoroutineRequest {
  python::ObjectPtr object;
  std::shared_ptr<PythonFile> file;
  SourceRange where;
};

}  // namespace launch
