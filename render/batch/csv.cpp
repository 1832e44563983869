#include "render/batch/csv.h"

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::render {

namespace {

class CsvParser {
 public:
  CsvParser(std::string_view text, std::string_view where) : text_(text), where_(where) {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  }

  std::vector<CsvRow> rows() {
    std::vector<CsvRow> all;
    while (at_ < text_.size()) {
      CsvRow row = readRow();
      if (row.fields.size() > 1 || !row.fields[0].empty()) all.push_back(std::move(row));
    }
    return all;
  }

 private:
  CsvRow readRow() {
    CsvRow row;
    row.line = line_;
    row.fields.push_back(readField());
    while (at_ < text_.size() && text_[at_] == ',') {
      ++at_;
      row.fields.push_back(readField());
    }
    if (at_ < text_.size() && text_[at_] == '\r') ++at_;
    if (at_ < text_.size() && text_[at_] == '\n') ++at_, ++line_;
    return row;
  }

  std::string readField() {
    if (at_ < text_.size() && text_[at_] == '"') return readQuoted();
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n' && !isEndByCrLf()) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }

  std::string readQuoted() {
    const std::size_t start = line_;
    std::string field;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] != '"') {
        field += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        field += text_[++at_];
      } else {
        ++at_;
        if (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n' && !isEndByCrLf())
          throw Error(place(line_), "text behind the end of a quoted field", "a comma or the end of the line");
        return field;
      }
    }
    throw Error(place(start), "a quoted field does not end", "a '\"'");
  }

  bool isEndByCrLf() const { return text_[at_] == '\r' && (at_ + 1 == text_.size() || text_[at_ + 1] == '\n'); }
  std::string place(std::size_t line) const { return fmt::format("{}:{}", where_, line); }

  std::string_view text_, where_;
  std::size_t at_ = 0, line_ = 1;
};

}  // namespace

std::vector<CsvRow> parseCsv(std::string_view text, std::string_view where) { return CsvParser(text, where).rows(); }

}  // namespace malus::render
