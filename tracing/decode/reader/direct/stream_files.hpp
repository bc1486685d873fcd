// SPDX-License-Identifier: Apache-2.0
// The files of the streams of a trace, and the order of their packets. Private to the reader.
#pragma once

#include <filesystem>
#include <system_error>
#include <vector>

#include "tracing/decode/ctf/packet.hpp"

namespace tracing {

// The stream files of a trace, in the order of their names. There is an error when another program has removed the
// directory.
std::vector<std::filesystem::path> stream_files(const std::filesystem::path& directory, std::error_code& error);

// Sorts the packets of one stream, from all its files, by time. A packet that is in several snapshots counts once.
void put_in_order(std::vector<ctf::Packet>& packets);

}  // namespace tracing
