// SPDX-License-Identifier: Apache-2.0
// The reader of ordinary YAML agrees with yaml-cpp, places included, and leaves the rest to it.
#include "launcher/frontend/simple_yaml.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "launcher/base/read_source_file.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/input_text.hpp"
#include "tests/support/yaml_tree/yaml_tree.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;
using test_support::tree_text;

LocatedText in_a_file(const std::string& text) {
  const auto file = std::make_shared<SourceFile>("/test/x.yaml", text);
  return LocatedText(text, {file, 0, static_cast<std::uint32_t>(text.size())});
}

std::string by_yaml_cpp(const LocatedText& text) {
  std::vector<Diagnostic> errors;
  const std::string tree = tree_text(read_any_yaml(text, errors));
  EXPECT_TRUE(errors.empty()) << text.text();
  return tree;
}

// The text of the tree of a list that is handed over item by item; nothing when it isn't.
std::optional<std::string> item_by_item(const LocatedText& source, const std::string& name) {
  YamlNode root;
  root.kind = YamlNode::Kind::kMapping;
  YamlNode list;
  list.kind = YamlNode::Kind::kSequence;
  const std::optional<YamlNode> key =
      read_simple_yaml_list(source, name, [&](YamlNode& item) { list.items.push_back(std::move(item)); });
  if (!key) {
    return std::nullopt;
  }
  const std::optional<YamlNode> whole = read_simple_yaml(source);
  EXPECT_TRUE(whole);
  list.where = whole->entries.front().value.where;
  root.where = whole->where;
  root.entries.push_back({*key, std::move(list)});
  return tree_text(root);
}

TEST(SimpleYaml, ReadsWhatIsOrdinaryAsYamlCppDoes) {
  for (const char* const text : {
           "launch:\n- arg: {name: rate, default: \"10\"}\n- node:\n    pkg: demo\n    param:\n    - name: a\n      "
           "value: [1.5, -2]\n",
           "# before\n---\na: 1 # one\n\n  # between\nb:   two words  \n",
           "a:\n  b:\n    - c: 'it''s'\n      d: \"say \\\"x\\\" \\\\ \"\n    - - 1\n      - 2\ne: yes\n",
           "a:\n- b: c:d\n- x.y, z\n- $(eval '1 + 2')\n",
           "\"quoted key\": {a: [b, 'c d'], \"e\": {}}\n'k': []\n",
           "[1.0, 2.5]",
           "{a: b}",
           "a: -1\nb: +.5\nc: 0x1F\nd: ''",
       }) {
    SCOPED_TRACE(text);
    const LocatedText source = in_a_file(text);
    const std::optional<YamlNode> simple = read_simple_yaml(source);
    ASSERT_TRUE(simple);
    EXPECT_EQ(tree_text(*simple), by_yaml_cpp(source));
  }
}

TEST(SimpleYaml, LeavesTheRestToYamlCpp) {
  for (const char* const text : {
           "",
           "# nothing\n",
           "a:\n",
           "a: ~\n",
           "a: 1\na: 2\n",
           "a: |\n  text\n",
           "a: one\n  two\n",
           "a: &x 1\nb: *x\n",
           "a: !!str 1\n",
           "<<: {a: 1}\n",
           "a: \"tab\\t\"\n",
           "a:\t1\n",
           "a: 1\r\n",
           "a: b: c\n",
           "a: 1\n b: 2\n",
           "- a\nb: c\n",
           "a: {b: c\n}\n",
           "a: [b,c]\n",
           "a: 'x\n",
           "a\n",
           "a: 1\n---\nb: 2\n",
           "? a\n",
           "a: [1]x\n",
           "a: @b\n",
           "%YAML 1.1\n",
       }) {
    EXPECT_FALSE(read_simple_yaml(in_a_file(text))) << text;
  }
}

TEST(SimpleYaml, HandsOverTheItemsOfAList) {
  for (const char* const text : {"launch:\n- arg: {name: rate}\n- group:\n  - node:\n      param:\n      - a: 1\n- x\n",
                                 "---\n'launch': # all\n  - - 1\n    - 2\n  - [a, b]\n\n"}) {
    const LocatedText source = in_a_file(text);
    EXPECT_EQ(item_by_item(source, "launch"), by_yaml_cpp(source)) << text;
  }
  for (const char* const text :
       {"launch: []\n", "launch: {a: b}\n", "launch:\n  a: b\n", "start:\n- a\n", "launch:\n- a\nmore:\n- b\n",
        "launch:\n- a: 1\n  a: 2\n", "- launch\n", "[launch]", "launch:\n", "", "launch\n"}) {
    EXPECT_EQ(item_by_item(in_a_file(text), "launch"), std::nullopt) << text;
  }
}

// Every YAML file of the repository, and the real ones where they are.
TEST(SimpleYaml, AgreesOverWholeFiles) {
  int files = 0;
  int simple_files = 0;
  for (const fs::path& root : {fs::path(GOLDEN_FILES), fs::path(EXAMPLES), fs::path(SHARED_CORPUS)}) {
    if (!fs::exists(root)) {
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      const std::string extension = entry.path().extension();
      if (!entry.is_regular_file() || (extension != ".yaml" && extension != ".yml")) {
        continue;
      }
      const auto file = read_source_file(entry.path());
      const LocatedText source(file->text(), {file, 0, static_cast<std::uint32_t>(file->text().size())});
      if (find_bad_character(source)) {
        continue;
      }
      ++files;
      if (const std::optional<YamlNode> simple = read_simple_yaml(source)) {
        ++simple_files;
        const std::string tree = by_yaml_cpp(source);
        EXPECT_EQ(tree_text(*simple), tree) << entry.path();
        EXPECT_EQ(item_by_item(source, "launch").value_or(tree), tree) << entry.path();
      }
    }
  }
  EXPECT_GT(simple_files, files / 5) << "of " << files;
}

TEST(SimpleYaml, PlainScalarsStandForThemselves) {
  for (const char* const text :
       {"a", "two words", "1:30", "-1.5", "$(var x) s", "/a/b", "it's", "a, b", "0x1F", "x=\"y\"", "_"}) {
    ASSERT_TRUE(is_plain_scalar(text)) << text;
    std::vector<Diagnostic> errors;
    EXPECT_EQ(read_any_yaml(LocatedText(text), errors).scalar.text.text(), text);
  }
  for (const char* const text :
       {"", " a", "a ", "a: b", "a:", "a # b", "- a", "---", "...", "[a]", "'a'", "*a", "@x", "a\nb", "\xC3\xA4"}) {
    EXPECT_FALSE(is_plain_scalar(text)) << text;
  }
}

}  // namespace
}  // namespace launch
