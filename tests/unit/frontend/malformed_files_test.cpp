// SPDX-License-Identifier: Apache-2.0
// Malformed launch files, each with its complete error text: tests/golden/diagnostics/FILE and FILE.expected.
// LAUNCH_UPDATE_GOLDEN=1 writes the expected texts anew; read them before committing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "launcher/substitution/template_parser.hpp"
#include "tests/unit/frontend/entity_test_support.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Parses every text attribute as a template, as the actions do after the tree has been read.
void collect_template_errors(const Entity& entity, std::vector<Diagnostic>& errors) {
  for (const Attribute& attribute : entity.attributes) {
    if (const Scalar* scalar = attribute.value.scalar()) {
      try {
        parse_template(scalar->text);
      } catch (const LaunchError& error) {
        errors.insert(errors.end(), error.diagnostics().begin(), error.diagnostics().end());
      }
    }
  }
  for (const Entity& child : entity.children) {
    collect_template_errors(child, errors);
  }
}

std::string complaints(const fs::path& path) {
  const auto file = file_of(path.filename().string(), read(path));
  std::vector<Diagnostic> errors;
  try {
    collect_template_errors(load_entity_tree(file), errors);
  } catch (const LaunchError& error) {
    errors = error.diagnostics();
  }
  return render(errors);
}

TEST(MalformedFiles, AreExplainedAtTheirPlace) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(GOLDEN_FILES "/diagnostics")) {
    if (entry.path().extension() != ".expected") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 10U);
  for (const fs::path& path : files) {
    const fs::path expected = path.string() + ".expected";
    const std::string found = complaints(path);
    EXPECT_NE(found, "") << path << " is not malformed";
    if (std::getenv("LAUNCH_UPDATE_GOLDEN") != nullptr) {
      std::ofstream(expected, std::ios::binary) << found;
    }
    EXPECT_EQ(found, read(expected)) << path;
  }
}

// Files that can't be kept as text files in a repository.
TEST(MalformedFiles, InOtherEncodingsAreRefused) {
  EXPECT_EQ(load_error(file_of("a.launch.xml", std::string("\xFF\xFE<\0l\0", 6))),
            "a.launch.xml:1:1: error: the file is encoded in UTF-16\n"
            "    1 | \xEF\xBF\xBD\xEF\xBF\xBD<\xEF\xBF\xBDl\xEF\xBF\xBD\n"
            "      | ^\n"
            "      = help: save it as UTF-8\n");
  EXPECT_EQ(load_error(file_of("a.launch.xml", "<launch>\n<!-- gr\xFCn --></launch>")),
            "a.launch.xml:2:8: error: the byte 0xFC is not UTF-8\n"
            "    2 | <!-- gr\xEF\xBF\xBDn --></launch>\n"
            "      |        ^\n"
            "      = help: save the file as UTF-8\n");
  EXPECT_EQ(load_error(file_of("a.launch.yaml", "launch:\n- log: {message: \"\x01\"}\n")),
            "a.launch.yaml:2:19: error: the control character U+0001 is not allowed in a launch file\n"
            "    2 | - log: {message: \"\xEF\xBF\xBD\"}\n"
            "      |                   ^\n");
  EXPECT_EQ(load_error(file_of("a.launch.xml", "<?xml version=\"1.0\" encoding=\"EUC-JP\"?>\n<launch/>")),
            "a.launch.xml:1:31: error: the encoding 'EUC-JP' is not supported\n"
            "    1 | <?xml version=\"1.0\" encoding=\"EUC-JP\"?>\n"
            "      |                               ^~~~~~\n"
            "      = help: save the file as UTF-8\n");
}

TEST(MalformedFiles, EmptyOnesAreRefused) {
  EXPECT_EQ(load_error(file_of("a.launch.xml", "\n")),
            "a.launch.xml:2:1: error: the file holds no element\n"
            "    2 | \n"
            "      | ^\n"
            "      = help: expected <launch> ... </launch>\n");
  EXPECT_EQ(load_error(file_of("a.launch.yaml", "# nothing\n")),
            "a.launch.yaml:1:1: error: the file is empty\n"
            "    1 | # nothing\n"
            "      | ^\n"
            "      = help: a launch file begins with 'launch:'\n");
}

TEST(MalformedFiles, GiveNoMoreThanTwentyErrors) {
  std::string text = "<launch>\n";
  for (int i = 0; i < 1000; ++i) {
    text += "<a b=c/>\n";
  }
  try {
    xml(text + "</launch>");
    FAIL() << "no error";
  } catch (const LaunchError& error) {
    EXPECT_EQ(error.diagnostics().size(), 20U);
  }
}

}  // namespace
}  // namespace launch
