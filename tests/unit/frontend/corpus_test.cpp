// SPDX-License-Identifier: Apache-2.0
// Real launch files of many projects: their syntax is fine, so both front ends must accept them all.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "base/diagnostics/read_source_file.hpp"
#include "launcher/substitution/template_parser.hpp"
#include "tests/unit/frontend/entity_test_support.hpp"

namespace launch {
namespace {

struct CorpusFile {
  std::string name;
  bool loads_upstream;
};

// The columns of FILES.tsv: file, format, licence, repository, commit, loads_upstream, upstream_message.
std::vector<CorpusFile> corpus_files() {
  std::ifstream list(CORPUS "/FILES.tsv");
  std::vector<CorpusFile> files;
  std::string line;
  std::getline(list, line);  // titles
  while (std::getline(list, line)) {
    files.push_back({line.substr(0, line.find('\t')), line.find("\tok\t") != std::string::npos});
  }
  return files;
}

// Every text attribute must parse as a template.
void expect_templates_parse(const Entity& entity) {
  for (const Attribute& attribute : entity.attributes) {
    if (const Scalar* scalar = attribute.value.scalar()) {
      EXPECT_NO_THROW(parse_template(scalar->text)) << scalar->text.text();
    }
  }
  for (const Entity& child : entity.children) {
    expect_templates_parse(child);
  }
}

TEST(Corpus, IsAccepted) {
  const std::vector<CorpusFile> files = corpus_files();
  ASSERT_GT(files.size(), 900U);
  for (const CorpusFile& corpus_file : files) {
    const auto file = read_source_file(CORPUS "/launch_files/" + corpus_file.name);
    EXPECT_EQ(load_error(file), "") << corpus_file.name;
    if (corpus_file.loads_upstream) {
      expect_templates_parse(load_entity_tree(file));
    }
  }
}

}  // namespace
}  // namespace launch
