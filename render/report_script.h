// Runs one of the Python scripts of tools/report, by Debian's Python, which has matplotlib and Jinja2.
#pragma once

#include <string>
#include <vector>

namespace malus::render {

// script: file name. input: what it reads from its standard input. Throws Error: the script or Python is missing, or
// it failed; it has said why on stderr.
void runReportScript(const std::string& script, const std::vector<std::string>& arguments, const std::string& input,
                     const std::string& failure);

}  // namespace malus::render
