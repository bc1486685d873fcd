// SPDX-License-Identifier: Apache-2.0
// `launch trace` as a program of its own, so that its tests need nothing else from launch.
#include "programs/launch/trace/trace_command.hpp"

int main(int argc, char** argv) {
  return tracing::run_trace_command(std::vector<std::string>(argv + 1, argv + argc));
}
