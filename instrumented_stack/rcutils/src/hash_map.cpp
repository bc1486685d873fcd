// SPDX-License-Identifier: Apache-2.0
#include "rcutils/types/hash_map.h"

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "allocated.hpp"

namespace rcutils {

struct HashedPair {
  HashedPair(List<uint8_t> a_key, List<uint8_t> a_value) : key(std::move(a_key)), value(std::move(a_value)) {}

  List<uint8_t> key;
  List<uint8_t> value;
};

// By the hashes that the program computes. Hashes may be equal, hence a multimap.
using Pairs = std::unordered_multimap<size_t, HashedPair, std::hash<size_t>, std::equal_to<>,
                                      Memory<std::pair<const size_t, HashedPair>>>;

}  // namespace rcutils

namespace {

using rcutils::Pairs;

size_t power_of_two(size_t least) {
  size_t power = 1;
  while (power < least) {
    power *= 2;
  }
  return power;
}

}  // namespace

struct rcutils_hash_map_impl_s {
  Pairs pairs;
  size_t capacity;
  size_t key_size;
  size_t data_size;
  rcutils_hash_map_key_hasher_t hash;
  rcutils_hash_map_key_cmp_t compare;
  rcutils_allocator_t allocator;

  Pairs::iterator find(const void* key) {
    auto [pair, end] = pairs.equal_range(hash(key));
    while (pair != end && compare(pair->second.key.data(), key) != 0) {
      ++pair;
    }
    return pair == end ? pairs.end() : pair;
  }

  rcutils::List<uint8_t> copy(const void* bytes, size_t size) const {
    const auto* begin = static_cast<const uint8_t*>(bytes);
    return {begin, begin + size, rcutils::Memory<uint8_t>(allocator)};
  }
};

size_t rcutils_hash_map_string_hash_func(const void* key_str) {
  return std::hash<std::string_view>()(*static_cast<const char* const*>(key_str));
}

int rcutils_hash_map_string_cmp_func(const void* val1, const void* val2) {
  return strcmp(*static_cast<const char* const*>(val1), *static_cast<const char* const*>(val2));
}

rcutils_hash_map_t rcutils_get_zero_initialized_hash_map(void) {
  return {};
}

rcutils_ret_t rcutils_hash_map_init(rcutils_hash_map_t* hash_map, size_t initial_capacity, size_t key_size,
                                    size_t data_size, rcutils_hash_map_key_hasher_t key_hashing_func,
                                    rcutils_hash_map_key_cmp_t key_cmp_func, const rcutils_allocator_t* allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(hash_map, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(key_hashing_func, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(key_cmp_func, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(allocator, "hash map has no valid allocator", return RCUTILS_RET_INVALID_ARGUMENT)
  if (initial_capacity == 0 || key_size == 0 || data_size == 0) {
    RCUTILS_SET_ERROR_MSG(initial_capacity == 0 ? "initial_capacity cannot be less than 1"
                          : key_size == 0       ? "key_size cannot be less than 1"
                                                : "data_size cannot be less than 1");
    return RCUTILS_RET_INVALID_ARGUMENT;
  }
  try {
    hash_map->impl = rcutils::make<rcutils_hash_map_impl_s>(
        *allocator, Pairs(rcutils::Memory<Pairs::value_type>(*allocator)), power_of_two(initial_capacity), key_size,
        data_size, key_hashing_func, key_cmp_func, *allocator);
  } catch (const std::bad_alloc&) {
    RCUTILS_SET_ERROR_MSG("out of memory for a hash map");
    return RCUTILS_RET_BAD_ALLOC;
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_hash_map_fini(rcutils_hash_map_t* hash_map) {
  HASH_MAP_VALIDATE_HASH_MAP(hash_map)
  const rcutils_allocator_t allocator = hash_map->impl->allocator;
  rcutils::destroy(allocator, hash_map->impl);
  hash_map->impl = nullptr;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_hash_map_get_capacity(const rcutils_hash_map_t* hash_map, size_t* capacity) {
  HASH_MAP_VALIDATE_HASH_MAP(hash_map)
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(capacity, RCUTILS_RET_INVALID_ARGUMENT);
  *capacity = hash_map->impl->capacity;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_hash_map_get_size(const rcutils_hash_map_t* hash_map, size_t* size) {
  HASH_MAP_VALIDATE_HASH_MAP(hash_map)
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(size, RCUTILS_RET_INVALID_ARGUMENT);
  *size = hash_map->impl->pairs.size();
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_hash_map_set(rcutils_hash_map_t* hash_map, const void* key, const void* value) {
  HASH_MAP_VALIDATE_HASH_MAP(hash_map)
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(key, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(value, RCUTILS_RET_INVALID_ARGUMENT);
  rcutils_hash_map_impl_s& map = *hash_map->impl;
  const auto found = map.find(key);
  if (found != map.pairs.end()) {
    memcpy(found->second.value.data(), value, map.data_size);
    return RCUTILS_RET_OK;
  }
  try {
    map.pairs.emplace(map.hash(key), rcutils::HashedPair{map.copy(key, map.key_size), map.copy(value, map.data_size)});
  } catch (const std::bad_alloc&) {
    RCUTILS_SET_ERROR_MSG("out of memory for a hash map");
    return RCUTILS_RET_BAD_ALLOC;
  }
  if (4 * map.pairs.size() >= 3 * map.capacity) {
    map.capacity *= 2;
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_hash_map_unset(rcutils_hash_map_t* hash_map, const void* key) {
  HASH_MAP_VALIDATE_HASH_MAP(hash_map)
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(key, RCUTILS_RET_INVALID_ARGUMENT);
  const auto found = hash_map->impl->find(key);
  if (found != hash_map->impl->pairs.end()) {
    hash_map->impl->pairs.erase(found);
  }
  return RCUTILS_RET_OK;
}

bool rcutils_hash_map_key_exists(const rcutils_hash_map_t* hash_map, const void* key) {
  return hash_map != nullptr && hash_map->impl != nullptr && key != nullptr &&
         hash_map->impl->find(key) != hash_map->impl->pairs.end();
}

rcutils_ret_t rcutils_hash_map_get(const rcutils_hash_map_t* hash_map, const void* key, void* data) {
  HASH_MAP_VALIDATE_HASH_MAP(hash_map)
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(key, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(data, RCUTILS_RET_INVALID_ARGUMENT);
  const auto found = hash_map->impl->find(key);
  if (found == hash_map->impl->pairs.end()) {
    return RCUTILS_RET_NOT_FOUND;
  }
  memcpy(data, found->second.value.data(), hash_map->impl->data_size);
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_hash_map_get_next_key_and_data(const rcutils_hash_map_t* hash_map, const void* previous_key,
                                                     void* key, void* data) {
  HASH_MAP_VALIDATE_HASH_MAP(hash_map)
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(key, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(data, RCUTILS_RET_INVALID_ARGUMENT);
  rcutils_hash_map_impl_s& map = *hash_map->impl;
  auto next = map.pairs.begin();
  if (previous_key != nullptr) {
    next = map.find(previous_key);
    if (next == map.pairs.end()) {
      return RCUTILS_RET_NOT_FOUND;
    }
    ++next;
  }
  if (next == map.pairs.end()) {
    return RCUTILS_RET_HASH_MAP_NO_MORE_ENTRIES;
  }
  memcpy(key, next->second.key.data(), map.key_size);
  memcpy(data, next->second.value.data(), map.data_size);
  return RCUTILS_RET_OK;
}
