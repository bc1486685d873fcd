// SPDX-License-Identifier: Apache-2.0
// The hash SHA-256 (FIPS 180-4) of bytes that come in parts.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "rcutils/visibility_control.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RCUTILS_SHA256_BLOCK_SIZE 32

typedef struct rcutils_sha256_ctx_s {
  uint8_t data[64];
  size_t datalen;
  uint64_t bitlen;
  uint32_t state[8];
} rcutils_sha256_ctx_t;

void rcutils_sha256_init(rcutils_sha256_ctx_t* ctx);
void rcutils_sha256_update(rcutils_sha256_ctx_t* ctx, const uint8_t* data, size_t data_len);
// The context must be initialized anew for another hash.
void rcutils_sha256_final(rcutils_sha256_ctx_t* ctx, uint8_t output_hash[RCUTILS_SHA256_BLOCK_SIZE]);

#ifdef __cplusplus
}
#endif
