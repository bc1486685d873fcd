// SPDX-License-Identifier: Apache-2.0
// The largest tree of launch files among the real ones, made ready to be loaded.
#pragma once

#include <map>
#include <string>

namespace bench {

struct CorpusTree {
  std::string file;  // of its root; empty: the real launch files are not here
  std::map<std::string, std::string> arguments;
  std::map<std::string, std::string> environment;
};

// Makes a prefix with stand-ins for packages and programs in `directory`.
CorpusTree prepare_corpus_tree(const std::string& directory);

}  // namespace bench
