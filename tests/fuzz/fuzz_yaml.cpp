// SPDX-License-Identifier: Apache-2.0
// The front end of YAML launch files.
#include "tests/fuzz/fuzz_frontend.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::run_frontend(launch::parse_yaml, data, size);
  return 0;
}
