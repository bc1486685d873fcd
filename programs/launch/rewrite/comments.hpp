// SPDX-License-Identifier: Apache-2.0
// The comments of a launch file, for a file that is written anew in another language.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostics/source.hpp"

namespace launch {

class Comments {
 public:
  // The file must be one that load_entity_tree() takes.
  explicit Comments(const std::shared_ptr<const SourceFile>& file);

  // What stands before this byte and was not taken yet: the lines of comments, and "" for a blank line, of which one is
  // left of several. Blank lines without a comment count if they stand directly before.
  std::vector<std::string> take_before(std::size_t offset);
  std::vector<std::string> take_rest();

 private:
  struct Line {
    std::size_t at = 0;
    std::string text;  // without its mark; "" for a blank line
    bool is_blank = false;
  };

  void read_xml(const SourceFile& file);
  void read_yaml(const std::shared_ptr<const SourceFile>& file);
  void add(std::size_t at, std::string_view text);

  std::vector<Line> lines_;
  std::size_t next_ = 0;
};

}  // namespace launch
