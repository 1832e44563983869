// Runs a Python script of tools/report with Debian's Python, for which matplotlib and Jinja2 are packaged.
#pragma once

#include <string>
#include <vector>

namespace malus::render {

// script: file name. input: its standard input. failure: message if the script fails; it prints the reason to stderr.
// Throws Error: the script or Python is missing, or the script failed.
void runReportScript(const std::string& script, const std::vector<std::string>& arguments, const std::string& input,
                     const std::string& failure);

}  // namespace malus::render
