// SPDX-License-Identifier: Apache-2.0
// Reads the text of a `metadata` file, which LTTng writes in packets.
#pragma once

#include <filesystem>
#include <string>

namespace tracing::ctf {

// Plain text is returned as it is. A packet that is not complete, as in a trace that is still being written, is left
// out with everything after it. Throws UnsupportedTrace when the file can't be read or is no CTF 1.8.
std::string read_metadata(const std::filesystem::path& file);

}  // namespace tracing::ctf
