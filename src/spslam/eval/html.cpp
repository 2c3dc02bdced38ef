// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/html.h"

namespace spslam {

std::string html_escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const auto byte = [&](std::size_t k) { return k < left ? static_cast<unsigned char>(bytes[i + k]) : 0U; };
    const unsigned bits = byte(0) << 16U | byte(1) << 8U | byte(2);
    out += digits[bits >> 18U];
    out += digits[bits >> 12U & 63U];
    out += left > 1 ? digits[bits >> 6U & 63U] : '=';
    out += left > 2 ? digits[bits & 63U] : '=';
  }
  return out;
}

std::string html_table(const std::vector<std::vector<std::string>>& rows, bool has_head) {
  std::string html = "<table>\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const bool head_row = has_head && r == 0;
    html += head_row ? "<tr class=\"head\">" : "<tr>";
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const bool head = head_row || c == 0;
      html += (head ? "<th>" : "<td>") + html_escaped(rows[r][c]) + (head ? "</th>" : "</td>");
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace spslam
