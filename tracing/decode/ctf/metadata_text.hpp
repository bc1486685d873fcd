// SPDX-License-Identifier: Apache-2.0
// Reads the text of a `metadata` file, which LTTng writes in packets.
#pragma once

#include <filesystem>
#include <string>

namespace tracing::ctf {

struct MetadataText {
  std::string text;
  // A packet is not complete, as in a trace that is still being written or in a damaged file. It is left out with
  // everything after it.
  bool is_cut = false;
};

// Plain text is returned as it is. Throws UnsupportedTrace when the file can't be read or is no CTF 1.8.
MetadataText read_metadata_text(const std::filesystem::path& file);
std::string read_metadata(const std::filesystem::path& file);

}  // namespace tracing::ctf
