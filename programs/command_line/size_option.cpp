// SPDX-License-Identifier: Apache-2.0
#include "programs/command_line/size_option.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

namespace launch {

CLI::Validator size_in_bytes() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        constexpr std::string_view kUnits = "KMG";
        std::string_view digits = text;
        unsigned shift = 0;
        if (!digits.empty()) {
          const auto last = static_cast<char>(std::toupper(static_cast<unsigned char>(digits.back())));
          if (const std::size_t unit = kUnits.find(last); unit != std::string_view::npos) {
            shift = static_cast<unsigned>(unit + 1) * 10;
            digits.remove_suffix(1);
          }
        }
        std::uint64_t number = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (digits.empty() || error != std::errc() || end != digits.data() + digits.size() ||
            number > (std::numeric_limits<std::uint64_t>::max() >> shift)) {
          return fmt::format("'{}' is no size; write bytes, or a number with K, M or G", text);
        }
        text = std::to_string(number << shift);
        return {};
      },
      "");
}

}  // namespace launch
