// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/direct/stream_files.hpp"

#include <algorithm>
#include <string>
#include <tuple>

namespace tracing {

namespace fs = std::filesystem;

void put_in_order(std::vector<ctf::Packet>& packets) {
  const auto key = [](const ctf::Packet& packet) {
    return std::tuple(packet.time_begin, packet.sequence_number, packet.time_end, packet.content_bits);
  };
  std::stable_sort(packets.begin(), packets.end(),
                   [&](const ctf::Packet& a, const ctf::Packet& b) { return key(a) < key(b); });
  const auto same = [&](const ctf::Packet& a, const ctf::Packet& b) {
    return a.sequence_number && a.file != b.file && key(a) == key(b);
  };
  packets.erase(std::unique(packets.begin(), packets.end(), same), packets.end());
}

std::vector<fs::path> stream_files(const fs::path& directory, std::error_code& error) {
  std::vector<fs::path> files;
  fs::directory_iterator entry(directory, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename();
    std::error_code gone;
    if (entry->is_regular_file(gone) && name != "metadata" && !name.starts_with('.')) {
      files.push_back(entry->path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace tracing
