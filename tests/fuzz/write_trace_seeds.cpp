// SPDX-License-Identifier: Apache-2.0
// write_trace_seeds TRACES NUMBERS: what fuzz_trace and fuzz_trace_equality begin with, a file for each seed.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "tests/fuzz/trace_input.hpp"
#include "tests/support/trace_writer/example_system.hpp"
#include "tests/support/trace_writer/random_trace.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"

namespace {

namespace fs = std::filesystem;
using namespace tracing;

constexpr std::uint32_t kSeeds = 200;
constexpr std::size_t kLongest = 16'384;  // bytes; the fuzz targets get nothing longer

void write(const fs::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content.substr(0, kLongest);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    return 2;
  }
  const fs::path traces = argv[1];
  const fs::path numbers = argv[2];
  fs::create_directories(traces);
  fs::create_directories(numbers);
  const testing::TemporaryDirectory directory;
  testing::write_example_system(directory.path() / "example", 1);
  write(traces / "example", fuzz::trace_as_input(directory.path() / "example"));
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const std::string name = "seed" + std::to_string(seed);
    testing::write_random_trace(directory.path() / name, seed);
    const std::string input = fuzz::trace_as_input(directory.path() / name);
    if (input.size() <= kLongest) {
      write(traces / name, input);
    }
    std::mt19937_64 random(seed);
    std::string bytes;
    for (std::size_t i = 0; i < 2'000 * (1 + seed % 8); ++i) {
      bytes.push_back(static_cast<char>(random()));
    }
    write(numbers / name, bytes);
  }
  return EXIT_SUCCESS;
}
