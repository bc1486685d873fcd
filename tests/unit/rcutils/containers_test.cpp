// SPDX-License-Identifier: Apache-2.0
// The containers of rcutils, hashes, and what else programs in C use of it.
#include <gtest/gtest.h>
#include <rcutils/error_handling.h>
#include <rcutils/filesystem.h>
#include <rcutils/logging.h>
#include <rcutils/sha256.h>
#include <rcutils/types.h>
#include <unistd.h>

#include <algorithm>
#include <cstdarg>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

namespace {

const rcutils_allocator_t kHeap = rcutils_get_default_allocator();

std::string error() {
  const std::string text = rcutils_get_error_state() == nullptr ? "" : rcutils_get_error_state()->message;
  rcutils_reset_error();
  return text;
}

// Has memory for so many calls; then it has none.
rcutils_allocator_t allocator_for(int& calls) {
  rcutils_allocator_t allocator = kHeap;
  allocator.state = &calls;
  allocator.allocate = [](size_t size, void* state) -> void* {
    return (*static_cast<int*>(state))-- > 0 ? malloc(size) : nullptr;
  };
  return allocator;
}

TEST(ArrayList, CopiesElementsOfOneSize) {
  rcutils_array_list_t list = rcutils_get_zero_initialized_array_list();
  EXPECT_EQ(rcutils_array_list_fini(&list), RCUTILS_RET_NOT_INITIALIZED);
  EXPECT_EQ(error(), "array_list is not initialized");
  ASSERT_EQ(rcutils_array_list_init(&list, 1, sizeof(int), &kHeap), RCUTILS_RET_OK);
  for (const int value : {1, 2, 3, 4}) {
    ASSERT_EQ(rcutils_array_list_add(&list, &value), RCUTILS_RET_OK);
  }
  ASSERT_EQ(rcutils_array_list_remove(&list, 1), RCUTILS_RET_OK);
  const int seven = 7;
  ASSERT_EQ(rcutils_array_list_set(&list, 2, &seven), RCUTILS_RET_OK);
  size_t size = 0;
  ASSERT_EQ(rcutils_array_list_get_size(&list, &size), RCUTILS_RET_OK);
  std::vector<int> values(size);
  for (size_t i = 0; i < size; ++i) {
    ASSERT_EQ(rcutils_array_list_get(&list, i, &values[i]), RCUTILS_RET_OK);
  }
  EXPECT_EQ(values, (std::vector<int>{1, 3, 7}));
  EXPECT_EQ(rcutils_array_list_remove(&list, 3), RCUTILS_RET_INVALID_ARGUMENT);
  EXPECT_EQ(error(), "index is out of bounds of the list");
  EXPECT_EQ(rcutils_array_list_fini(&list), RCUTILS_RET_OK);
}

rcutils_ret_t print(rcutils_char_array_t* array, const char* format, ...) {
  va_list args;
  va_start(args, format);
  const rcutils_ret_t result = rcutils_char_array_vsprintf(array, format, args);
  va_end(args);
  return result;
}

TEST(CharArray, GrowsWithItsText) {
  rcutils_char_array_t array = rcutils_get_zero_initialized_char_array();
  ASSERT_EQ(rcutils_char_array_init(&array, 4, &kHeap), RCUTILS_RET_OK);
  ASSERT_EQ(rcutils_char_array_strcpy(&array, "joint"), RCUTILS_RET_OK);
  ASSERT_EQ(rcutils_char_array_strcat(&array, "_1"), RCUTILS_RET_OK);
  EXPECT_STREQ(array.buffer, "joint_1");
  EXPECT_EQ(array.buffer_length, 8u);
  ASSERT_EQ(print(&array, "%s of %d", "a long text that needs more room", 12), RCUTILS_RET_OK);
  EXPECT_STREQ(array.buffer, "a long text that needs more room of 12");
  EXPECT_EQ(rcutils_char_array_fini(&array), RCUTILS_RET_OK);
}

TEST(CharArray, LeavesTheBufferOfAnotherOwnerAlone) {
  char buffer[] = "abc";
  rcutils_char_array_t array{buffer, false, sizeof(buffer), sizeof(buffer), kHeap};
  ASSERT_EQ(rcutils_char_array_strcat(&array, "def"), RCUTILS_RET_OK);
  EXPECT_STREQ(array.buffer, "abcdef");
  EXPECT_STREQ(buffer, "abc");
  EXPECT_EQ(rcutils_char_array_fini(&array), RCUTILS_RET_OK);
}

TEST(HashMap, KeepsOneValueForAKey) {
  rcutils_hash_map_t map = rcutils_get_zero_initialized_hash_map();
  ASSERT_EQ(rcutils_hash_map_init(&map, 3, sizeof(const char*), sizeof(int), rcutils_hash_map_string_hash_func,
                                  rcutils_hash_map_string_cmp_func, &kHeap),
            RCUTILS_RET_OK);
  size_t capacity = 0;
  ASSERT_EQ(rcutils_hash_map_get_capacity(&map, &capacity), RCUTILS_RET_OK);
  EXPECT_EQ(capacity, 4u);
  const std::vector<std::string> names{"shoulder", "elbow", "wrist", "shoulder"};
  for (int i = 0; i < 4; ++i) {
    const char* key = names[i].c_str();
    ASSERT_EQ(rcutils_hash_map_set(&map, &key, &i), RCUTILS_RET_OK);
  }
  const char* wrist = "wrist";
  EXPECT_TRUE(rcutils_hash_map_key_exists(&map, &wrist));
  ASSERT_EQ(rcutils_hash_map_unset(&map, &wrist), RCUTILS_RET_OK);
  EXPECT_FALSE(rcutils_hash_map_key_exists(&map, &wrist));
  std::set<std::pair<std::string, int>> pairs;
  const char* key = nullptr;
  const char* previous = nullptr;
  int value = 0;
  while (rcutils_hash_map_get_next_key_and_data(&map, previous == nullptr ? nullptr : &previous, &key, &value) ==
         RCUTILS_RET_OK) {
    pairs.emplace(key, value);
    previous = key;
  }
  EXPECT_EQ(pairs, (std::set<std::pair<std::string, int>>{{"elbow", 1}, {"shoulder", 3}}));
  EXPECT_EQ(rcutils_hash_map_get(&map, &wrist, &value), RCUTILS_RET_NOT_FOUND);
  EXPECT_EQ(rcutils_hash_map_fini(&map), RCUTILS_RET_OK);
}

TEST(StringMap, GrowsOnlyIfItMay) {
  rcutils_string_map_t map = rcutils_get_zero_initialized_string_map();
  ASSERT_EQ(rcutils_string_map_init(&map, 1, kHeap), RCUTILS_RET_OK);
  EXPECT_EQ(rcutils_string_map_init(&map, 1, kHeap), RCUTILS_RET_STRING_MAP_ALREADY_INIT);
  EXPECT_EQ(error(), "string_map already initialized");
  ASSERT_EQ(rcutils_string_map_set(&map, "frame", "map"), RCUTILS_RET_OK);
  EXPECT_EQ(rcutils_string_map_set_no_resize(&map, "robot", "arm"), RCUTILS_RET_NOT_ENOUGH_SPACE);
  ASSERT_EQ(rcutils_string_map_set(&map, "robot", "arm"), RCUTILS_RET_OK);
  ASSERT_EQ(rcutils_string_map_set(&map, "frame", "odom"), RCUTILS_RET_OK);
  EXPECT_STREQ(rcutils_string_map_getn(&map, "frames", 5), "odom");
  std::vector<std::string> keys;
  for (const char* key = rcutils_string_map_get_next_key(&map, nullptr); key != nullptr;
       key = rcutils_string_map_get_next_key(&map, key)) {
    keys.push_back(key);
  }
  EXPECT_EQ(keys, (std::vector<std::string>{"frame", "robot"}));
  EXPECT_EQ(rcutils_string_map_unset(&map, "frames"), RCUTILS_RET_STRING_KEY_NOT_FOUND);
  EXPECT_EQ(error(), "key 'frames' not found");
  EXPECT_EQ(rcutils_string_map_fini(&map), RCUTILS_RET_OK);
}

TEST(StringMap, TellsThatThereIsNoMemory) {
  for (int calls = 0; calls < 4; ++calls) {
    int left = calls;
    rcutils_string_map_t map = rcutils_get_zero_initialized_string_map();
    rcutils_ret_t result = rcutils_string_map_init(&map, 1, allocator_for(left));
    if (result == RCUTILS_RET_OK) {
      result = rcutils_string_map_set(&map, "key", "value");
    }
    EXPECT_EQ(result, RCUTILS_RET_BAD_ALLOC) << calls;
    EXPECT_EQ(error(), "out of memory for a string map");
    EXPECT_EQ(rcutils_string_map_fini(&map), RCUTILS_RET_OK);
  }
}

TEST(StringArray, IsComparedSortedAndResized) {
  rcutils_string_array_t array;
  ASSERT_EQ(rcutils_string_array_init(&array, 3, &kHeap), RCUTILS_RET_OK);
  array.data[0] = strdup("b");
  array.data[2] = strdup("a");
  ASSERT_EQ(rcutils_string_array_sort(&array), RCUTILS_RET_OK);
  EXPECT_STREQ(array.data[0], "a");
  EXPECT_EQ(array.data[2], nullptr);
  rcutils_string_array_t shorter;
  ASSERT_EQ(rcutils_string_array_init(&shorter, 1, &kHeap), RCUTILS_RET_OK);
  shorter.data[0] = strdup("a");
  int result = 0;
  ASSERT_EQ(rcutils_string_array_cmp(&shorter, &array, &result), RCUTILS_RET_OK);
  EXPECT_LT(result, 0);
  ASSERT_EQ(rcutils_string_array_resize(&array, 1), RCUTILS_RET_OK);
  ASSERT_EQ(rcutils_string_array_cmp(&shorter, &array, &result), RCUTILS_RET_OK);
  EXPECT_EQ(result, 0);
  EXPECT_EQ(rcutils_string_array_fini(&array), RCUTILS_RET_OK);
  EXPECT_EQ(rcutils_string_array_fini(&shorter), RCUTILS_RET_OK);
}

std::string sha256_of(const std::string& text, size_t part) {
  rcutils_sha256_ctx_t context;
  rcutils_sha256_init(&context);
  for (size_t i = 0; i < text.size(); i += part) {
    rcutils_sha256_update(&context, reinterpret_cast<const uint8_t*>(text.data()) + i, std::min(part, text.size() - i));
  }
  uint8_t hash[RCUTILS_SHA256_BLOCK_SIZE];
  rcutils_sha256_final(&context, hash);
  std::string digits;
  for (const uint8_t byte : hash) {
    char two[3];
    snprintf(two, sizeof(two), "%02x", byte);
    digits += two;
  }
  return digits;
}

// The examples of FIPS 180-4, and a text of more than a block in parts of any size.
TEST(Sha256, IsThatOfTheStandard) {
  EXPECT_EQ(sha256_of("", 1), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of("abc", 3), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 56),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  const std::string text(200, 'x');
  EXPECT_EQ(sha256_of(text, 7), sha256_of(text, 200));
  EXPECT_EQ(sha256_of(text, 64), sha256_of(text, 200));
}

TEST(ErrorHandling, PutsTheEarlierErrorBehindTheNewOne) {
  rcutils_set_error_state("no such port", "port.cpp", 3);
  RCUTILS_SET_ERROR_MSG_AND_APPEND_PREV_ERROR("cannot open the arm");
  EXPECT_EQ(error(), "cannot open the arm: no such port, at port.cpp:3");
  rcutils_set_error_state("no such port", "port.cpp", 3);
  RCUTILS_SET_ERROR_MSG_WITH_FORMAT_STRING_AND_APPEND_PREV_ERROR("cannot open %s", "/dev/arm");
  EXPECT_EQ(error(), "cannot open /dev/arm: no such port, at port.cpp:3");
}

TEST(Directory, IsReadEntryByEntry) {
  char path[] = "/tmp/rcutils_XXXXXX";
  ASSERT_NE(mkdtemp(path), nullptr);
  ASSERT_TRUE(rcutils_mkdir((std::string(path) + "/maps").c_str()));
  std::set<std::string> names;
  rcutils_dir_iter_t* iter = rcutils_dir_iter_start(path, kHeap);
  ASSERT_NE(iter, nullptr);
  do {
    names.insert(iter->entry_name);
  } while (rcutils_dir_iter_next(iter));
  rcutils_dir_iter_end(iter);
  EXPECT_EQ(names, (std::set<std::string>{".", "..", "maps"}));
  EXPECT_EQ(rcutils_dir_iter_start((std::string(path) + "/none").c_str(), kHeap), nullptr);
  EXPECT_EQ(error(), "cannot open directory '" + std::string(path) + "/none': No such file or directory");
  rmdir((std::string(path) + "/maps").c_str());
  rmdir(path);
}

TEST(Logging, FormatsALineForOthers) {
  rcutils_char_array_t line = rcutils_get_zero_initialized_char_array();
  ASSERT_EQ(rcutils_char_array_init(&line, 1, &kHeap), RCUTILS_RET_OK);
  const rcutils_log_location_t place{"move", "arm.cpp", 7};
  ASSERT_EQ(rcutils_logging_format_message(&place, RCUTILS_LOG_SEVERITY_WARN, "arm", 1'500'000'000, "slow", &line),
            RCUTILS_RET_OK);
  EXPECT_STREQ(line.buffer, "[WARN] [0000000001.500000000] [arm]: slow");
  EXPECT_EQ(rcutils_char_array_fini(&line), RCUTILS_RET_OK);
  EXPECT_STREQ(g_rcutils_log_severity_names[RCUTILS_LOG_SEVERITY_ERROR], "ERROR");
}

}  // namespace
