// SPDX-License-Identifier: Apache-2.0
// Small files and files of the kernel (proc(5)), which a stream takes longer to open than to read.
#pragma once

#include <optional>
#include <string>

namespace launch {

// The whole file; nothing when it can't be opened or read, as when its process has ended.
std::optional<std::string> read_small_file(const std::string& path);

}  // namespace launch
