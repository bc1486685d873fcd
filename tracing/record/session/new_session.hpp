// SPDX-License-Identifier: Apache-2.0
// A session that is being set up.
#pragma once

#include <string>

#include "tracing/record/plan/trace_config.hpp"

namespace tracing {

// A session that is destroyed again unless its set-up succeeds, with the directory that was made for it. Throws
// TraceError when it can't be created.
class NewSession {
 public:
  explicit NewSession(const TraceConfig& config);
  ~NewSession();
  NewSession(const NewSession&) = delete;
  NewSession& operator=(const NewSession&) = delete;

  void keep() { kept_ = true; }

 private:
  std::string name_;
  std::string directory_;  // of the recording; "": it existed before, or the trace is on another machine
  bool kept_ = false;
};

}  // namespace tracing
