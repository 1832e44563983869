// Tables of comma-separated values (RFC 4180): fields in double quotes may contain commas, line ends and, doubled,
// quotes. Line ends are LF or CR LF; a byte order mark is skipped.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace malus::render {

struct CsvRow {
  std::size_t line = 0;  // at which the row begins, from 1
  std::vector<std::string> fields;
};

// The rows that are not empty. where: the file, for errors. Throws Error for a quote that does not end, or text behind
// one.
std::vector<CsvRow> parseCsv(std::string_view text, std::string_view where);

}  // namespace malus::render
