// SPDX-License-Identifier: Apache-2.0
#include "rcutils/types/string_map.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "allocated.hpp"
#include "rcutils/error_handling.h"

namespace rcutils {

// A text that does not move: the map hands out pointers to its characters.
class OwnText {
 public:
  OwnText(const char* text, const rcutils_allocator_t& allocator)
      : text_(make<Text>(allocator, text, Memory<char>(allocator))), allocator_(allocator) {}
  OwnText(OwnText&& other) noexcept : text_(std::exchange(other.text_, nullptr)), allocator_(other.allocator_) {}
  OwnText& operator=(OwnText&& other) noexcept {
    std::swap(text_, other.text_);
    return *this;
  }
  ~OwnText() {
    if (text_ != nullptr) {
      destroy(allocator_, text_);
    }
  }
  const char* c_str() const { return text_->c_str(); }

 private:
  Text* text_;
  rcutils_allocator_t allocator_;
};

struct StringPair {
  OwnText key;
  OwnText value;
};

}  // namespace rcutils

struct rcutils_string_map_impl_s {
  rcutils::List<rcutils::StringPair> entries;
  size_t capacity;
  rcutils_allocator_t allocator;

  rcutils::StringPair* find(std::string_view key) {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const rcutils::StringPair& e) { return key == e.key.c_str(); });
    return found == entries.end() ? nullptr : &*found;
  }
};

#define CHECK_STRING_MAP(map)                                         \
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(map, RCUTILS_RET_INVALID_ARGUMENT); \
  RCUTILS_CHECK_FOR_NULL_WITH_MSG((map)->impl, "invalid string map", return RCUTILS_RET_STRING_MAP_INVALID)

namespace {

rcutils_ret_t no_memory() {
  RCUTILS_SET_ERROR_MSG("out of memory for a string map");
  return RCUTILS_RET_BAD_ALLOC;
}

}  // namespace

rcutils_string_map_t rcutils_get_zero_initialized_string_map(void) {
  return {};
}

rcutils_ret_t rcutils_string_map_init(rcutils_string_map_t* string_map, size_t initial_capacity,
                                      rcutils_allocator_t allocator) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(string_map, RCUTILS_RET_INVALID_ARGUMENT);
  if (string_map->impl != nullptr) {
    RCUTILS_SET_ERROR_MSG("string_map already initialized");
    return RCUTILS_RET_STRING_MAP_ALREADY_INIT;
  }
  RCUTILS_CHECK_ALLOCATOR_WITH_MSG(&allocator, "invalid allocator", return RCUTILS_RET_INVALID_ARGUMENT)
  try {
    string_map->impl = rcutils::make<rcutils_string_map_impl_s>(
        allocator, rcutils::List<rcutils::StringPair>(rcutils::Memory<rcutils::StringPair>(allocator)), size_t{0},
        allocator);
  } catch (const std::bad_alloc&) {
    return no_memory();
  }
  const rcutils_ret_t reserved = rcutils_string_map_reserve(string_map, initial_capacity);
  if (reserved != RCUTILS_RET_OK) {
    rcutils::destroy(allocator, string_map->impl);
    string_map->impl = nullptr;
  }
  return reserved;
}

rcutils_ret_t rcutils_string_map_fini(rcutils_string_map_t* string_map) {
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(string_map, RCUTILS_RET_INVALID_ARGUMENT);
  if (string_map->impl != nullptr) {
    const rcutils_allocator_t allocator = string_map->impl->allocator;
    rcutils::destroy(allocator, string_map->impl);
    string_map->impl = nullptr;
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_map_get_capacity(const rcutils_string_map_t* string_map, size_t* capacity) {
  CHECK_STRING_MAP(string_map);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(capacity, RCUTILS_RET_INVALID_ARGUMENT);
  *capacity = string_map->impl->capacity;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_map_get_size(const rcutils_string_map_t* string_map, size_t* size) {
  CHECK_STRING_MAP(string_map);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(size, RCUTILS_RET_INVALID_ARGUMENT);
  *size = string_map->impl->entries.size();
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_map_reserve(rcutils_string_map_t* string_map, size_t capacity) {
  CHECK_STRING_MAP(string_map);
  rcutils_string_map_impl_s& map = *string_map->impl;
  const size_t wanted = std::max(capacity, map.entries.size());
  if (wanted > map.entries.max_size()) {
    RCUTILS_SET_ERROR_MSG("requested capacity for string_map too large");
    return RCUTILS_RET_BAD_ALLOC;
  }
  try {
    map.entries.reserve(wanted);
  } catch (const std::bad_alloc&) {
    return no_memory();
  }
  map.capacity = wanted;
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_map_clear(rcutils_string_map_t* string_map) {
  CHECK_STRING_MAP(string_map);
  string_map->impl->entries.clear();
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_map_set(rcutils_string_map_t* string_map, const char* key, const char* value) {
  const rcutils_ret_t result = rcutils_string_map_set_no_resize(string_map, key, value);
  if (result != RCUTILS_RET_NOT_ENOUGH_SPACE) {
    return result;
  }
  const rcutils_ret_t reserved =
      rcutils_string_map_reserve(string_map, std::max(2 * string_map->impl->capacity, size_t{1}));
  return reserved == RCUTILS_RET_OK ? rcutils_string_map_set_no_resize(string_map, key, value) : reserved;
}

rcutils_ret_t rcutils_string_map_set_no_resize(rcutils_string_map_t* string_map, const char* key, const char* value) {
  CHECK_STRING_MAP(string_map);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(key, RCUTILS_RET_INVALID_ARGUMENT);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(value, RCUTILS_RET_INVALID_ARGUMENT);
  rcutils_string_map_impl_s& map = *string_map->impl;
  try {
    if (rcutils::StringPair* entry = map.find(key)) {
      entry->value = rcutils::OwnText(value, map.allocator);
    } else if (map.entries.size() == map.capacity) {
      return RCUTILS_RET_NOT_ENOUGH_SPACE;
    } else {
      map.entries.push_back({rcutils::OwnText(key, map.allocator), rcutils::OwnText(value, map.allocator)});
    }
  } catch (const std::bad_alloc&) {
    return no_memory();
  }
  return RCUTILS_RET_OK;
}

rcutils_ret_t rcutils_string_map_unset(rcutils_string_map_t* string_map, const char* key) {
  CHECK_STRING_MAP(string_map);
  RCUTILS_CHECK_ARGUMENT_FOR_NULL(key, RCUTILS_RET_INVALID_ARGUMENT);
  rcutils_string_map_impl_s& map = *string_map->impl;
  rcutils::StringPair* entry = map.find(key);
  if (entry == nullptr) {
    RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING("key '%s' not found", key);
    return RCUTILS_RET_STRING_KEY_NOT_FOUND;
  }
  map.entries.erase(map.entries.begin() + (entry - map.entries.data()));
  return RCUTILS_RET_OK;
}

bool rcutils_string_map_key_exists(const rcutils_string_map_t* string_map, const char* key) {
  return rcutils_string_map_get(string_map, key) != nullptr;
}

bool rcutils_string_map_key_existsn(const rcutils_string_map_t* string_map, const char* key, size_t key_length) {
  return rcutils_string_map_getn(string_map, key, key_length) != nullptr;
}

const char* rcutils_string_map_get(const rcutils_string_map_t* string_map, const char* key) {
  return key == nullptr ? nullptr : rcutils_string_map_getn(string_map, key, strlen(key));
}

const char* rcutils_string_map_getn(const rcutils_string_map_t* string_map, const char* key, size_t key_length) {
  if (string_map == nullptr || string_map->impl == nullptr || key == nullptr) {
    return nullptr;
  }
  const rcutils::StringPair* entry = string_map->impl->find({key, key_length});
  return entry == nullptr ? nullptr : entry->value.c_str();
}

const char* rcutils_string_map_get_next_key(const rcutils_string_map_t* string_map, const char* key) {
  if (string_map == nullptr || string_map->impl == nullptr) {
    return nullptr;
  }
  const auto& entries = string_map->impl->entries;
  auto next = entries.begin();
  if (key != nullptr) {
    // The place of the text and not the text: another text with these characters is no key of this map.
    next =
        std::find_if(next, entries.end(), [&](const rcutils::StringPair& entry) { return entry.key.c_str() == key; });
    next += next == entries.end() ? 0 : 1;
  }
  return next == entries.end() ? nullptr : next->key.c_str();
}

rcutils_ret_t rcutils_string_map_copy(const rcutils_string_map_t* src_string_map,
                                      rcutils_string_map_t* dst_string_map) {
  CHECK_STRING_MAP(src_string_map);
  CHECK_STRING_MAP(dst_string_map);
  for (const rcutils::StringPair& entry : src_string_map->impl->entries) {
    const rcutils_ret_t result = rcutils_string_map_set(dst_string_map, entry.key.c_str(), entry.value.c_str());
    if (result != RCUTILS_RET_OK) {
      return result;
    }
  }
  return RCUTILS_RET_OK;
}
