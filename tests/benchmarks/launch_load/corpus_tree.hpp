// SPDX-License-Identifier: Apache-2.0
// Prepares the largest tree among the real launch files for loading.
#pragma once

#include <map>
#include <string>

namespace bench {

struct CorpusTree {
  std::string file;  // of the root of the tree; empty: the real launch files are not here
  std::map<std::string, std::string> arguments;
  std::map<std::string, std::string> environment;
};

// Makes a prefix with stand-ins for packages and programs in `directory`.
CorpusTree prepare_corpus_tree(const std::string& directory);

}  // namespace bench
