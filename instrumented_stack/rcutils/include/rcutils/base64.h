// SPDX-License-Identifier: Apache-2.0
// Bytes as text (RFC 4648, base64), as parameter files have them with the tag !!binary.
#pragma once

#include "rcutils/allocator.h"
#include "rcutils/types/rcutils_ret.h"
#include "rcutils/types/uint8_array.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCUTILS_BASE64_ENCODED_MAX_LENGTH (64 * 1024 * 1024)  // characters; a text must be shorter

// Makes the bytes of a text in a zero-initialized array. An empty text leaves the array as it is.
// RCUTILS_RET_INVALID_ARGUMENT: an argument is null or invalid, or the array is in use. RCUTILS_RET_ERROR: the text is
// too long, its length is no multiple of 4, or it has characters or a padding that do not belong there.
// RCUTILS_RET_BAD_ALLOC.
rcutils_ret_t rcutils_decode_base64(const char* base64_str, rcutils_uint8_array_t* byte_array,
                                    const rcutils_allocator_t* allocator);

// Makes the text of bytes, which the caller gives back to the allocator. RCUTILS_RET_INVALID_ARGUMENT: an argument is
// null or invalid, or there are no bytes. RCUTILS_RET_ERROR: they are too many. RCUTILS_RET_BAD_ALLOC.
rcutils_ret_t rcutils_encode_base64(const rcutils_uint8_array_t* byte_array, char** base64_str,
                                    const rcutils_allocator_t* allocator);

#ifdef __cplusplus
}
#endif
