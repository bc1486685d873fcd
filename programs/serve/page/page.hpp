// SPDX-License-Identifier: Apache-2.0
// The pages, each one file with its style and scripts. Made from the files of this folder (embed_page.cmake).
#pragma once

#include <string>
#include <string_view>

namespace launch::serve {

extern const std::string_view kPage;
extern const std::string_view kLoginPage;
extern const std::string_view kWrongTokenPage;  // the login after a wrong token

// A browser runs only the style and scripts that carry the nonce of the answer's Content-Security-Policy.
std::string with_nonce(std::string_view page, std::string_view nonce);

}  // namespace launch::serve
