// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The few pieces of HTML that a report needs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace spslam {

// & < > " ' as entities, so that any text may stand in an element or in a quoted attribute.
std::string html_escaped(std::string_view text);
// RFC 4648, with padding.
std::string base64(std::string_view bytes);
// A table of text cells; the first column of each row names it, the first row is its head unless has_head is
// false. Columns after the first are aligned as numbers.
std::string html_table(const std::vector<std::vector<std::string>>& rows, bool has_head = true);

}  // namespace spslam
