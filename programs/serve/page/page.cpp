// SPDX-License-Identifier: Apache-2.0
#include "programs/serve/page/page.hpp"

namespace launch::serve {

std::string with_nonce(std::string_view page, std::string_view nonce) {
  constexpr std::string_view kPlace = "{nonce}";
  std::string text;
  for (std::size_t at; (at = page.find(kPlace)) != std::string_view::npos;) {
    text.append(page.substr(0, at)).append(nonce);
    page.remove_prefix(at + kPlace.size());
  }
  return text.append(page);
}

}  // namespace launch::serve
