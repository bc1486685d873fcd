// SPDX-License-Identifier: Apache-2.0
// The exception for a trace that can't be read.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace tracing {

// A trace could not be read. what() is one line that names the directory. remedy() says what to do and may be empty.
// details() are the library's own messages, innermost last, for bug reports.
class TraceReadError : public std::runtime_error {
 public:
  TraceReadError(const std::string& what, std::string remedy, std::string details = {})
      : std::runtime_error(what), remedy_(std::move(remedy)), details_(std::move(details)) {}
  const std::string& remedy() const { return remedy_; }
  const std::string& details() const { return details_; }

 private:
  std::string remedy_;
  std::string details_;
};

}  // namespace tracing
