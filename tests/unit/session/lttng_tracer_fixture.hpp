// SPDX-License-Identifier: Apache-2.0
// The real tracer on a session daemon of the test's own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "tests/support/sandbox.hpp"
#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/tracer.hpp"

namespace trace_test {

inline bool never() {
  return false;
}

struct LttngTracer : testing::Test {
  tracing::TraceConfig config_named(const std::string& name) const {
    tracing::TraceConfig config;
    config.session_name = name;
    config.base_path = sandbox.trace_directory();
    return config;
  }

  // "what\nremedy" of the error that start() throws.
  std::string start_error(const tracing::TraceConfig& config) {
    try {
      tracer->start(config);
    } catch (const tracing::TraceError& error) {
      return std::string(error.what()) + "\n" + error.remedy();
    }
    return "no error";
  }

  test_support::Sandbox sandbox;
  std::unique_ptr<tracing::Tracer> tracer = tracing::make_lttng_tracer();
};

inline std::string daemon_pid_file() {
  const std::string home = std::string(getenv("LTTNG_HOME")) + "/.lttng";
  return (geteuid() == 0 ? "/run/lttng" : home) + "/lttng-sessiond.pid";
}

}  // namespace trace_test
