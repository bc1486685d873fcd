// SPDX-License-Identifier: Apache-2.0
// The page without data. A comment /*facts*/ and a comment /*columns*/ stand where they belong.
#pragma once

#include <string_view>

namespace tracing {

extern const std::string_view kPageTemplate;

}  // namespace tracing
