// SPDX-License-Identifier: Apache-2.0
#include "rcutils/sha256.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace {

// The first 32 bits of the fractional parts of the cube roots of the first 64 primes (FIPS 180-4, 4.2.2).
constexpr std::array<uint32_t, 64> kRoundConstants{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

uint32_t big_endian(const uint8_t* bytes) {
  return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

// Adds the 64 bytes of the block to the state (FIPS 180-4, 6.2.2).
void digest(rcutils_sha256_ctx_t& context) {
  std::array<uint32_t, 64> words;
  for (size_t i = 0; i < words.size(); ++i) {
    if (i < 16) {
      words[i] = big_endian(context.data + 4 * i);
      continue;
    }
    const uint32_t a = words[i - 15], b = words[i - 2];
    words[i] = words[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + words[i - 7] +
               (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
  }
  std::array<uint32_t, 8> s;
  std::copy(std::begin(context.state), std::end(context.state), s.begin());
  for (size_t i = 0; i < words.size(); ++i) {
    const uint32_t choice = (s[4] & s[5]) ^ (~s[4] & s[6]);
    const uint32_t majority = (s[0] & s[1]) ^ (s[0] & s[2]) ^ (s[1] & s[2]);
    const uint32_t first = s[7] + (std::rotr(s[4], 6) ^ std::rotr(s[4], 11) ^ std::rotr(s[4], 25)) + choice +
                           kRoundConstants[i] + words[i];
    const uint32_t second = (std::rotr(s[0], 2) ^ std::rotr(s[0], 13) ^ std::rotr(s[0], 22)) + majority;
    std::rotate(s.begin(), s.end() - 1, s.end());
    s[4] += first;
    s[0] = first + second;
  }
  for (size_t i = 0; i < s.size(); ++i) {
    context.state[i] += s[i];
  }
  context.datalen = 0;
}

}  // namespace

void rcutils_sha256_init(rcutils_sha256_ctx_t* ctx) {
  *ctx = {{}, 0, 0, {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19}};
}

void rcutils_sha256_update(rcutils_sha256_ctx_t* ctx, const uint8_t* data, size_t data_len) {
  ctx->bitlen += uint64_t{data_len} * 8;
  while (data_len != 0) {
    const size_t part = std::min(data_len, sizeof(ctx->data) - ctx->datalen);
    std::memcpy(ctx->data + ctx->datalen, data, part);
    ctx->datalen += part;
    data += part;
    data_len -= part;
    if (ctx->datalen == sizeof(ctx->data)) {
      digest(*ctx);
    }
  }
}

void rcutils_sha256_final(rcutils_sha256_ctx_t* ctx, uint8_t output_hash[RCUTILS_SHA256_BLOCK_SIZE]) {
  const uint64_t bits = ctx->bitlen;
  constexpr size_t kLengthAt = sizeof(ctx->data) - sizeof(bits);
  const auto fill_up = [&](size_t end) { std::memset(ctx->data + ctx->datalen, 0, end - ctx->datalen); };
  ctx->data[ctx->datalen++] = 0x80;
  if (ctx->datalen > kLengthAt) {
    fill_up(sizeof(ctx->data));
    digest(*ctx);
  }
  fill_up(kLengthAt);
  for (size_t i = 0; i < sizeof(bits); ++i) {
    ctx->data[kLengthAt + i] = static_cast<uint8_t>(bits >> (56 - 8 * i));
  }
  digest(*ctx);
  for (size_t i = 0; i < RCUTILS_SHA256_BLOCK_SIZE; ++i) {
    output_hash[i] = static_cast<uint8_t>(ctx->state[i / 4] >> (24 - 8 * (i % 4)));
  }
}
