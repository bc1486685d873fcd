// SPDX-License-Identifier: Apache-2.0
// Memory for parts of files, which stays where it is until all of it is free again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace tracing::ctf {

class ByteArena {
 public:
  // `size`: bytes of a slab. A larger part has a slab of its own.
  explicit ByteArena(std::size_t size) : size_(size) {}

  std::uint8_t* allocate(std::size_t count);
  // All is free again. Two slabs are kept for the next time.
  void reset();
  std::size_t used() const { return used_; }  // bytes that were asked for since the last reset()

 private:
  struct Slab {
    std::unique_ptr<std::uint8_t[]> bytes;
    std::size_t size = 0;
  };

  std::size_t size_;
  std::vector<Slab> slabs_;
  std::size_t slab_ = 0;          // the slab in use
  std::size_t used_in_slab_ = 0;  // the used part of it
  std::size_t used_ = 0;
};

}  // namespace tracing::ctf
