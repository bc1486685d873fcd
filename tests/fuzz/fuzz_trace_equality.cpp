// SPDX-License-Identifier: Apache-2.0
// A valid trace whose shape and values the input decides. Our decoder and libbabeltrace2 must read the same from it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/trace_writer/random_trace.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_text.hpp"

namespace {

using namespace tracing;

// The input, eight bytes a time; then zeros.
class InputNumbers {
 public:
  InputNumbers(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}
  std::uint64_t operator()() {
    std::uint64_t number = 0;
    const std::size_t count = std::min(left_, sizeof number);
    std::memcpy(&number, data_, count);
    data_ += count;
    left_ -= count;
    return number;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const testing::TemporaryDirectory directory;
  const std::filesystem::path trace = directory.path() / "trace";
  std::filesystem::remove_all(trace);
  testing::write_random_trace(trace, InputNumbers(data, size));
  const std::vector<std::string> expected = testing::trace_text(trace, TraceReader::Decoder::kBabeltrace);
  const std::vector<std::string> seen =
      testing::lines_of_babeltrace(testing::trace_text(trace, TraceReader::Decoder::kDirect));
  if (seen == expected) {
    return 0;
  }
  for (std::size_t i = 0; i < std::max(seen.size(), expected.size()); ++i) {
    const std::string ours = i < seen.size() ? seen[i] : "nothing";
    const std::string theirs = i < expected.size() ? expected[i] : "nothing";
    if (ours != theirs) {
      std::fprintf(stderr, "ours:   %s\ntheirs: %s\n", ours.c_str(), theirs.c_str());
    }
  }
  std::abort();
}
