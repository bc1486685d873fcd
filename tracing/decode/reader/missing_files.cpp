// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/missing_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

#include "tracing/decode/reader/open_trace.hpp"

namespace tracing {

namespace fs = std::filesystem;

namespace {

std::uint64_t big_endian(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    value = value << 8 | static_cast<std::uint8_t>(bytes[at + i]);
  }
  return value;
}

// Where each packet of a stream file ends, in bytes, according to its index; empty if it is no such file. Its header
// has four numbers of 32 bits: a constant, the version in two numbers, and the size of an entry. An entry begins with
// three numbers of 64 bits: the place of the packet in bytes, and its sizes with and without padding in bits.
std::vector<std::uint64_t> ends_of_packets(const fs::path& index) {
  constexpr std::uint64_t kMagic = 0xc1f1dcc1;
  constexpr std::size_t kHeader = 16;
  constexpr std::size_t kLeastEntry = 24;
  std::ifstream stream(index, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (bytes.size() < kHeader || big_endian(bytes, 0, 4) != kMagic) {
    return {};
  }
  const std::size_t entry_size = big_endian(bytes, 12, 4);
  if (entry_size < kLeastEntry) {
    return {};
  }
  std::vector<std::uint64_t> ends;
  for (std::size_t at = kHeader; at + entry_size <= bytes.size(); at += entry_size) {
    ends.push_back(big_endian(bytes, at, 8) + big_endian(bytes, at + 8, 8) / 8);
  }
  return ends;
}

std::string packets(std::size_t count) {
  return fmt::format("{} packet{}", count, count == 1 ? "" : "s");
}

// Empty: nothing is missing.
std::string missing_of(const fs::path& file, const std::vector<std::uint64_t>& ends) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) {
    return fmt::format("'{}' is missing, with {}", file.string(), packets(ends.size()));
  }
  if (!fs::is_regular_file(status)) {
    return fmt::format("'{}' is no file; it should hold {}", file.string(), packets(ends.size()));
  }
  const std::uintmax_t size = fs::file_size(file, error);
  const auto missing = std::count_if(ends.begin(), ends.end(), [&](std::uint64_t end) { return end > size; });
  if (!error && missing == 0 && size > *std::max_element(ends.begin(), ends.end())) {
    return fmt::format("'{}' is longer than its {}: it was changed since", file.string(), packets(ends.size()));
  }
  if (error || missing == 0) {
    return {};
  }
  return fmt::format("'{}' ends early, without {} of {}", file.string(), missing, packets(ends.size()));
}

// Whether it begins as a packet with the magic number of CTF does, in either byte order.
bool is_stream(const fs::path& file) {
  std::array<char, 4> bytes{};
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(bytes.data(), bytes.size())) {
    return false;
  }
  const std::string magic(bytes.data(), bytes.size());
  return magic == "\xc1\x1f\xfc\xc1" || magic == "\xc1\xfc\x1f\xc1";
}

// Empty: the directory has metadata, or no stream.
std::string missing_metadata_of(const fs::path& directory) {
  std::error_code error;
  if (fs::is_regular_file(directory / "metadata", error)) {
    return {};
  }
  std::size_t streams = 0;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code gone;
    if (entry->is_regular_file(gone) && is_stream(entry->path())) {
      ++streams;
    }
  }
  if (streams == 0 || is_being_written(directory)) {
    return {};
  }
  return fmt::format("'{}' is missing, without which the {} of the directory can't be read",
                     (directory / "metadata").string(),
                     streams == 1 ? "stream file" : fmt::format("{} stream files", streams));
}

}  // namespace

std::vector<std::string> missing_packets(const fs::path& trace) {
  std::set<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(trace / "index", error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".idx") {
      files.insert(entry->path());
    }
  }
  std::vector<std::string> lines;
  for (const fs::path& index : files) {
    const std::vector<std::uint64_t> ends = ends_of_packets(index);
    if (ends.empty()) {
      continue;
    }
    const std::string line = missing_of(trace / index.stem(), ends);
    if (!line.empty()) {
      lines.push_back(line);
    }
  }
  return lines;
}

std::vector<std::string> missing_metadata(const fs::path& directory) {
  std::set<std::string> lines{missing_metadata_of(directory)};
  std::error_code error;
  fs::recursive_directory_iterator entry(directory, fs::directory_options::skip_permission_denied, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code gone;
    if (entry->is_directory(gone) && !entry->is_symlink(gone) && entry->path().filename() != "index") {
      lines.insert(missing_metadata_of(entry->path()));
    }
  }
  lines.erase("");
  return {lines.begin(), lines.end()};
}

}  // namespace tracing
