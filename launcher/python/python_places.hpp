// SPDX-License-Identifier: Apache-2.0
// Turns the file names and lines of Python's objects and errors into places in the kept source text.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "base/diagnostics/source.hpp"
#include "launcher/python/interpreter/python_runtime.hpp"

namespace launch {

// The places of one launch file and of the modules that it takes objects from.
class PythonPlaces {
 public:
  explicit PythonPlaces(std::shared_ptr<const SourceFile> file) : file_(std::move(file)) {}

  // The place, or the beginning of the launch file when it is unknown.
  SourceRange range(const python::Place& place);

  // Throws the exception of a call of the host, or a LaunchError at the place of Python's error.
  [[noreturn]] void fail(const python::Error& error);

 private:
  std::shared_ptr<const SourceFile> file_;
  std::map<std::string, std::shared_ptr<const SourceFile>> modules_;
};

}  // namespace launch
