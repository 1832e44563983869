// Text of unknown origin, such as names in files from elsewhere, made safe to show.
#pragma once

#include <string>
#include <string_view>

namespace malus {

// Replaces everything that could control a terminal or reorder a line by an escape of printable ASCII characters:
//   control characters (C0, C1, DEL)                  \x1b, \x9b
//   bytes that are not UTF-8                           \xff
//   bidirectional controls, line separators, invisible characters and noncharacters    \u{202e}
// Other UTF-8 is unchanged, so that names of any language stay readable. keepsNewlines: '\n' and '\t' are unchanged,
// for text of several lines. Idempotent. Categories: Unicode Standard, chapter 23; the threat: Unicode Technical
// Report 36.
std::string printable(std::string_view text, bool keepsNewlines = false);

// Shortens UTF-8 text to at most `columns` columns of a terminal; "..." replaces its end. Characters outside of ASCII
// count as two columns, the widest that a terminal draws.
std::string shortened(std::string_view text, std::size_t columns);

}  // namespace malus
