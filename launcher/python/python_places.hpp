// SPDX-License-Identifier: Apache-2.0
// Where Python's objects and errors stand: its file names and lines become places in the kept source text.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "launcher/base/source.hpp"
#include "launcher/python/interpreter/python_runtime.hpp"

namespace launch {

// Of one launch file and the modules that it takes objects from.
class PythonPlaces {
 public:
  explicit PythonPlaces(std::shared_ptr<const SourceFile> file) : file_(std::move(file)) {}

  // The place, or the beginning of the launch file when it is unknown.
  SourceRange range(const python::Place& place);

  // Throws what a call of the host threw, or a LaunchError at the place of Python's error.
  [[noreturn]] void fail(const python::Error& error);

 private:
  std::shared_ptr<const SourceFile> file_;
  std::map<std::string, std::shared_ptr<const SourceFile>> modules_;
};

// From now on errors of Python carry its traceback.
void show_python_tracebacks();

}  // namespace launch
