// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/json_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace launch {

void append_json_string(std::string& to, std::string_view text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](char byte) {
    return byte >= ' ' && byte < '\x7f' && byte != '"' && byte != '\\';  // a byte above 127 may be negative
  });
  if (plain) {
    to.append(1, '"').append(text).append(1, '"');
  } else {
    to += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
}

}  // namespace launch
