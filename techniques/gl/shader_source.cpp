#include "base/error.h"
#include "embedded_shaders.h"
#include "techniques/gl/program.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace shadowbench::gl {
namespace {

std::string_view embeddedText(const std::string& file, const std::string& includedFrom) {
    const auto files = embedded::shaders();
    const auto found = std::find_if(files.begin(), files.end(), [&](const auto& f) { return f.path == file; });
    if (found == files.end())
        throw InternalError("loading shader " + file + (includedFrom.empty() ? "" : ", included by " + includedFrom) +
                            ": no such file under techniques/");
    return found->text;
}

/// Appends `file`, each included file once.
void append(const std::string& file, const std::string& includedFrom, std::set<std::string>& seen, ShaderSource& out) {
    if (!seen.insert(file).second) return;
    std::istringstream lines{std::string(embeddedText(file, includedFrom))};
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        const std::string origin = file + ":" + std::to_string(number);
        if (line.starts_with("#include \"")) {
            append(line.substr(10, line.find('"', 10) - 10), origin, seen, out);
            continue;
        }
        out.text += line + "\n";
        out.origin.push_back(origin);
    }
}

} // namespace

ShaderSource loadShader(const std::string& file, const Defines& defines) {
    ShaderSource source;
    const auto prelude = [&](const std::string& line) {
        source.text += line + "\n";
        source.origin.push_back(file + ":0");
    };
    prelude("#version 450 core");
    for (const auto& [name, value] : defines) prelude("#define " + name + " " + value);
    std::set<std::string> seen;
    append(file, "", seen, source);
    return source;
}

} // namespace shadowbench::gl
