// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/ctf/streams/byte_arena.hpp"

#include <algorithm>

namespace tracing::ctf {

std::uint8_t* ByteArena::allocate(std::size_t count) {
  while (slab_ < slabs_.size() && slabs_[slab_].size - used_in_slab_ < count) {
    ++slab_;
    used_in_slab_ = 0;
  }
  if (slab_ == slabs_.size()) {
    const std::size_t size = std::max(size_, count);
    slabs_.push_back({std::unique_ptr<std::uint8_t[]>(new std::uint8_t[size]), size});
  }
  std::uint8_t* const allocated = slabs_[slab_].bytes.get() + used_in_slab_;
  used_in_slab_ += count;
  used_ += count;
  return allocated;
}

void ByteArena::reset() {
  constexpr std::size_t kKept = 2;
  std::erase_if(slabs_, [this](const Slab& slab) { return slab.size > size_; });
  slabs_.resize(std::min(slabs_.size(), kKept));
  slab_ = used_in_slab_ = used_ = 0;
}

}  // namespace tracing::ctf
