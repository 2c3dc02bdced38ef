// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// DBoW2's text: "k L scoring weighting", then a node a line, "parent is_leaf b0 .. b31 weight", ids from 1 in
// order of the lines, 0 for the root, which has no line.

#include <spdlog/fmt/fmt.h>

#include <charconv>
#include <cstring>

#include "spslam/base/atomic_file.h"
#include "spslam/base/error.h"
#include "spslam/base/mapped_file.h"
#include "spslam/loop/vocabulary.h"

namespace spslam {
namespace {

// The numbers of one line after the other.
class TextReader {
 public:
  TextReader(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  // Goes to the next line that is not blank; false at the end.
  bool next_line() {
    do {
      if (rest_.empty()) return false;
      const std::size_t end = rest_.find('\n');
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
      ++number_;
      skip_blanks();
    } while (line_.empty());
    return true;
  }
  template <class T>
  T number(T low, T high, const char* what) {
    T value = {};
    const auto [stop, code] = std::from_chars(line_.data(), line_.data() + line_.size(), value);
    if (code != std::errc() || !(value >= low && value <= high))
      fail(fmt::format("{} is missing or wrong", what));
    line_.remove_prefix(static_cast<std::size_t>(stop - line_.data()));
    if (!line_.empty() && line_[0] != ' ' && line_[0] != '\t' && line_[0] != '\r') fail("is not all numbers");
    skip_blanks();
    return value;
  }
  void end_line() const {
    if (!line_.empty()) fail("has more numbers than a node has");
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(
        fmt::format("{}:{}: {}; give a vocabulary in DBoW2's text format: 'k L scoring weighting', then "
                    "'parent is_leaf 32 bytes weight' a line",
                    name_, number_, what));
  }
  int line_number() const { return number_; }

 private:
  void skip_blanks() {
    const std::size_t first = line_.find_first_not_of(" \t\r");
    line_.remove_prefix(first == std::string_view::npos ? line_.size() : first);
  }

  std::string_view rest_, line_;
  const std::string& name_;
  int number_ = 0;
};

// Nodes as they stand in the text.
struct Lines {
  int branching = 0, levels = 0;
  std::vector<std::uint32_t> parents = {0};  // of each node, the root's own is 0
  std::vector<bool> is_leaf = {false};
  std::vector<Descriptor> descriptors = {{}};
  std::vector<float> weights = {0};
  std::vector<int> numbers = {1};  // of the lines
};

void read_node(TextReader& reader, Lines& lines) {
  const auto own = static_cast<std::uint32_t>(lines.parents.size());
  const auto parent = reader.number<std::uint32_t>(0, 0xFFFFFFFFU, "the parent");
  if (parent >= own) reader.fail(fmt::format("node {} comes before its parent {}", own, parent));
  if (lines.is_leaf[parent])
    reader.fail(fmt::format("its parent {} is a leaf by line {}", parent, lines.numbers[parent]));
  lines.parents.push_back(parent);
  lines.is_leaf.push_back(reader.number(0, 1, "is_leaf (0 or 1)") == 1);
  std::array<std::uint8_t, sizeof(Descriptor)> bytes = {};
  for (std::uint8_t& byte : bytes)
    byte = static_cast<std::uint8_t>(reader.number(0, 255, "a byte (0 to 255)"));
  std::memcpy(lines.descriptors.emplace_back().data(), bytes.data(), bytes.size());
  lines.weights.push_back(static_cast<float>(reader.number(0.0, 1e5, "the weight (0 to 1e5)")));
  lines.numbers.push_back(reader.line_number());
  reader.end_line();
}

Lines read_lines(std::string_view text, const std::string& name) {
  TextReader reader(text, name);
  Lines lines;
  if (!reader.next_line()) throw InputError(name + ": is empty; give a vocabulary in DBoW2's text format");
  lines.branching = reader.number(2, 20, "the branching k (2 to 20)");
  lines.levels = reader.number(1, 10, "the number of levels L (1 to 10)");
  reader.number(0, 5, "the scoring (0 to 5)");
  const int weighting = reader.number(0, 3, "the weighting (0 to 3)");
  if (weighting > 1)
    reader.fail(fmt::format("weighting {} is not supported, only 0 (TF-IDF) and 1 (TF) are", weighting));
  reader.end_line();
  while (reader.next_line()) read_node(reader, lines);
  return lines;
}

// The nodes in breadth-first order, each one's children in the order of their lines.
std::vector<std::uint32_t> breadth_first(const Lines& lines, std::vector<std::uint32_t>& first_child,
                                         const std::string& name) {
  const std::size_t nodes = lines.parents.size();
  std::vector<std::vector<std::uint32_t>> children(nodes);
  for (std::uint32_t node = 1; node < nodes; ++node) children[lines.parents[node]].push_back(node);
  std::vector<std::uint32_t> order = {0};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t node = order[i];
    first_child.push_back(static_cast<std::uint32_t>(order.size()));
    if (children[node].empty() != lines.is_leaf[node])
      throw InputError(
          fmt::format("{}:{}: node {} is no leaf but has no children; the file is cut off, use another "
                      "copy",
                      name, lines.numbers[node], node));
    if (children[node].size() > static_cast<std::size_t>(lines.branching))
      throw InputError(fmt::format("{}:{}: node {} has {} children, but k is {}", name, lines.numbers[node],
                                   node, children[node].size(), lines.branching));
    order.insert(order.end(), children[node].begin(), children[node].end());
  }
  first_child.push_back(static_cast<std::uint32_t>(nodes));
  return order;
}

}  // namespace

Vocabulary Vocabulary::parse_dbow2_text(std::string_view text, const std::string& name) {
  const Lines lines = read_lines(text, name);
  VocabularyTree tree;
  tree.branching = lines.branching;
  tree.levels = lines.levels;
  for (const std::uint32_t node : breadth_first(lines, tree.first_child, name)) {
    tree.descriptors.push_back(lines.descriptors[node]);
    tree.weights.push_back(lines.is_leaf[node] ? lines.weights[node] : 0);
  }
  try {
    return Vocabulary(tree);
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
}

Vocabulary Vocabulary::read_dbow2_text(const std::filesystem::path& path) {
  const MappedFile file(path);
  return parse_dbow2_text({reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()},
                          path.string());
}

void Vocabulary::write_dbow2_text(const std::filesystem::path& path) const {
  if (empty()) throw OutputError(path.string() + ": there are no words to write; train the vocabulary first");
  std::vector<std::uint32_t> parents(descriptors_.size(), 0);
  for (std::uint32_t node = 0; node + 1 < first_child_.size(); ++node)
    std::fill(parents.begin() + first_child_[node], parents.begin() + first_child_[node + 1], node);
  fmt::memory_buffer text;
  const auto out = fmt::appender(text);
  fmt::format_to(out, "{} {} 0 0\n", branching_, levels_);
  for (std::size_t node = 1; node < descriptors_.size(); ++node) {
    const bool leaf = first_child_[node] == first_child_[node + 1];
    fmt::format_to(out, "{} {}", parents[node], leaf ? 1 : 0);
    for (const std::byte byte : std::as_bytes(std::span(descriptors_[node])))
      fmt::format_to(out, " {}", std::to_integer<int>(byte));
    fmt::format_to(out, " {}\n", weights_[node]);
  }
  write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace spslam
