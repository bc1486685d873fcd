// SPDX-License-Identifier: Apache-2.0
#include "programs/command_line/size_option.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <optional>
#include <string>

#include "base/text/byte_size.hpp"

namespace launch {

CLI::Validator size_in_bytes() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        std::string upper = text;
        std::transform(upper.begin(), upper.end(), upper.begin(),
                       [](unsigned char letter) { return std::toupper(letter); });
        const std::optional<std::uint64_t> size = parse_byte_size(upper);
        if (!size) {
          return fmt::format("'{}' is no size; write bytes, or a number with K, M or G", text);
        }
        text = std::to_string(*size);
        return {};
      },
      "");
}

}  // namespace launch
