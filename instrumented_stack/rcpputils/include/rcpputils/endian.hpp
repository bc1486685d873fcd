// SPDX-License-Identifier: Apache-2.0
// The order of bytes in numbers: std::endian of C++20, for older programs, too.
#pragma once

#if __cplusplus > 201703L
#include <bit>

namespace rcpputils {
using std::endian;
}
#else
namespace rcpputils {
enum class endian { little = __ORDER_LITTLE_ENDIAN__, big = __ORDER_BIG_ENDIAN__, native = __BYTE_ORDER__ };
}
#endif
