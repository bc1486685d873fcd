// SPDX-License-Identifier: Apache-2.0
// Strings and files in C.
#include <errno.h>
#include <gtest/gtest.h>
#include <rcutils/filesystem.h>
#include <rcutils/find.h>
#include <rcutils/isalnum_no_locale.h>
#include <rcutils/qsort.h>
#include <rcutils/repl_str.h>
#include <rcutils/split.h>
#include <rcutils/strcasecmp.h>
#include <rcutils/strerror.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace {

const rcutils_allocator_t kAllocator = rcutils_get_default_allocator();

std::string taken(char* text) {
  const std::string result = text == nullptr ? "null" : text;
  free(text);
  return result;
}

using Split = rcutils_ret_t (*)(const char*, char, rcutils_allocator_t, rcutils_string_array_t*);

std::vector<std::string> parts(Split split, const char* text) {
  rcutils_string_array_t array = rcutils_get_zero_initialized_string_array();
  EXPECT_EQ(split(text, '/', kAllocator, &array), RCUTILS_RET_OK);
  const std::vector<std::string> result(array.data, array.data + array.size);
  EXPECT_EQ(rcutils_string_array_fini(&array), RCUTILS_RET_OK);
  return result;
}

using Parts = std::vector<std::string>;

TEST(Split, LeavesOutEmptyParts) {
  EXPECT_EQ(parts(rcutils_split, "/a//b/c/"), (Parts{"a", "b", "c"}));
  EXPECT_EQ(parts(rcutils_split, ""), Parts{});
  EXPECT_EQ(parts(rcutils_split, "a"), Parts{"a"});
  EXPECT_EQ(parts(rcutils_split_last, "a/b/c"), (Parts{"a/b", "c"}));
  EXPECT_EQ(parts(rcutils_split_last, "a"), Parts{"a"});
  EXPECT_EQ(rcutils_split("a", '/', kAllocator, nullptr), RCUTILS_RET_INVALID_ARGUMENT);
}

TEST(Text, IsFoundReplacedAndCompared) {
  EXPECT_EQ(rcutils_find("a/b/c", '/'), 1u);
  EXPECT_EQ(rcutils_find_last("a/b/c", '/'), 3u);
  EXPECT_EQ(rcutils_findn("a/b/c", 'c', 3), SIZE_MAX);
  EXPECT_EQ(rcutils_find_lastn("a/b/c", '/', 2), 1u);
  EXPECT_EQ(rcutils_find(nullptr, '/'), SIZE_MAX);
  EXPECT_EQ(taken(rcutils_repl_str("/a/b", "/", "--", &kAllocator)), "--a--b");
  EXPECT_EQ(taken(rcutils_repl_str("abc", "x", "y", &kAllocator)), "abc");
  int value = 7;
  EXPECT_EQ(rcutils_strcasecmp("Abc", "aBC", &value), 0);
  EXPECT_EQ(value, 0);
  EXPECT_EQ(rcutils_strncasecmp("Abc", "aBd", 2, &value), 0);
  EXPECT_EQ(value, 0);
  EXPECT_EQ(rcutils_strcasecmp(nullptr, "", &value), EINVAL);
  EXPECT_TRUE(rcutils_isalnum_no_locale('7') && !rcutils_isalnum_no_locale('_'));
}

TEST(Text, OfErrorsIsShortened) {
  char text[10];
  errno = ENOENT;
  rcutils_strerror(text, sizeof text);
  EXPECT_STREQ(text, "No such f");
}

TEST(Sort, OrdersAnArray) {
  int values[] = {3, 1, 2};
  const auto compare = [](const void* a, const void* b) {
    return *static_cast<const int*>(a) - *static_cast<const int*>(b);
  };
  EXPECT_EQ(rcutils_qsort(values, 3, sizeof(int), compare), RCUTILS_RET_OK);
  EXPECT_EQ(values[0], 1);
  EXPECT_EQ(values[2], 3);
  EXPECT_EQ(rcutils_qsort(nullptr, 3, sizeof(int), compare), RCUTILS_RET_INVALID_ARGUMENT);
}

TEST(Files, AreFoundAndMeasured) {
  char pattern[] = "/tmp/rcutils_test_XXXXXX";
  const std::string directory = mkdtemp(pattern);
  std::ofstream(directory + "/file") << "12345";
  EXPECT_TRUE(rcutils_mkdir((directory + "/below").c_str()));
  EXPECT_TRUE(rcutils_mkdir((directory + "/below").c_str()));
  EXPECT_FALSE(rcutils_mkdir("relative"));
  std::ofstream(directory + "/below/file") << "123";
  EXPECT_TRUE(rcutils_is_directory(directory.c_str()) && !rcutils_is_file(directory.c_str()));
  EXPECT_TRUE(rcutils_exists((directory + "/file").c_str()));
  EXPECT_TRUE(rcutils_is_readable_and_writable((directory + "/file").c_str()));
  EXPECT_EQ(rcutils_get_file_size((directory + "/file").c_str()), 5u);
  uint64_t size = 0;
  EXPECT_EQ(rcutils_calculate_directory_size(directory.c_str(), &size, kAllocator), RCUTILS_RET_OK);
  EXPECT_EQ(size, 5u);
  EXPECT_EQ(rcutils_calculate_directory_size_with_recursion(directory.c_str(), 0, &size, kAllocator), RCUTILS_RET_OK);
  EXPECT_EQ(size, 8u);
  EXPECT_EQ(taken(rcutils_join_path("/a", "b", kAllocator)), "/a/b");
  EXPECT_EQ(taken(rcutils_expand_user("/a", kAllocator)), "/a");
  std::filesystem::remove_all(directory);
}

}  // namespace
