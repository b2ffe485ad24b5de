#include "techniques/folder/compile_error.h"

#include "base/words.h"
#include "techniques/folder/reading.h"
#include "techniques/folder/vocabulary.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <sstream>

namespace shadowbench::techniques {
namespace {

constexpr std::string_view errorMark = ": error: ";
constexpr std::size_t longestName = 80; // of near matches: they take time and memory by its square

/// In words of the folder where Mesa's are of what the folder does not have.
std::string plain(const std::string& line) {
    if (const std::size_t at = line.find("preprocessor error: #version"); at != std::string::npos)
        return line.substr(0, at) + "error: leave #version out: shaders here are 4.50 core";
    if (const std::size_t at = line.find("; candidates are:"); at != std::string::npos) return line.substr(0, at);
    if (line.find("has no matching output in the previous stage") != std::string::npos)
        return line + ": casters' shaders have casterDepth and casterPosition, others no inputs";
    return line;
}

/// Of a variable or a function, as Mesa's line has it.
std::optional<std::string> unknownName(const std::string& line) {
    constexpr std::array ends{std::pair("`", "' undeclared"), std::pair("no function with name '", "'")};
    for (const auto& [before, after] : ends) {
        std::size_t begin = line.find(std::string(errorMark) + before);
        if (begin == std::string::npos) continue;
        begin += errorMark.size() + std::string_view(before).size();
        if (const std::size_t end = line.find(after, begin); end != std::string::npos)
            return line.substr(begin, end - begin);
    }
    return std::nullopt;
}

/// Of one that this line begins to define or declare, as our shaders are laid out; else "" or another name.
std::string functionOn(const std::string& line) {
    const std::size_t open = line.find('(');
    if (open == std::string::npos || std::isalpha(static_cast<unsigned char>(line.front())) == 0) return "";
    const std::size_t begin = line.rfind(' ', open) + 1;
    return line.substr(begin, open - begin);
}

class CompileError {
public:
    CompileError(const TechniqueFolder& folder, const FolderPass& pass, const gl::Defines& defines)
        : folder_(folder), pass_(pass), defines_(defines) {}

    /// The line of the compiler's log that is the first error, where warnings may come before; of the linker's, after the
    /// file.
    [[nodiscard]] std::string firstIn(const std::string& log) const {
        const std::string file = gl::placeOf(shaders(), pass_.shader);
        std::istringstream lines(log);
        std::string first;
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("0:0(0)")) line = file + line.substr(6); // of the file as a whole
            const std::size_t link = line.starts_with("linking ") ? line.find(" failed: ") : std::string::npos;
            if (link != std::string::npos) line = fmt::format("{}: {}", file, line.substr(link + 9));
            if (line.find(errorMark) != std::string::npos) return inFolder(withHint(plain(line)));
            if (line.find("preprocessor error: ") != std::string::npos) return inFolder(plain(line));
            if (first.empty() && !line.starts_with("compiling ")) first = line;
        }
        return first;
    }

private:
    [[nodiscard]] gl::ShaderFolder shaders() const { return {folder_.path.string(), folder_.shaders}; }
    [[nodiscard]] std::string ownPrefix() const { return folder_.path.string() + "/"; }

    /// What is found in a file of ours is what stands before its #include.
    [[nodiscard]] std::string inFolder(const std::string& line) const {
        const bool isOurs = !line.starts_with(ownPrefix()) && line.find(".glsl:") != std::string::npos;
        return isOurs ? fmt::format("{}: before or in its #include of {}", gl::placeOf(shaders(), pass_.shader), line)
                      : line;
    }

    [[nodiscard]] std::string withHint(const std::string& line) const {
        const gl::ShaderSource source = gl::loadShader(shaders(), pass_.shader, defines_);
        if (const auto name = unknownName(line))
            return name->size() > longestName ? line : line + didYouMean(*name, namesBut(*name, source));
        for (const char* ofTypes : {"type", "operand", "must be", "convert", "no matching function"})
            if (line.find(ofTypes, line.find(errorMark)) != std::string::npos) return line + parametersAt(line, source);
        return line;
    }

    /// All of the folder's own shaders, macros of parameters among them, functions of ours that they include, and uniforms.
    [[nodiscard]] std::vector<std::string> namesBut(const std::string& wrong, const gl::ShaderSource& source) const {
        const std::vector<std::string> uniforms = uniformNames(folder_);
        std::set<std::string> names(uniforms.begin(), uniforms.end());
        std::istringstream lines(source.text);
        std::string own;
        for (std::size_t i = 0; i < source.origin.size(); ++i) {
            std::string line;
            std::getline(lines, line);
            if (source.origin[i].starts_with(ownPrefix()))
                own += line + "\n";
            else
                names.insert(functionOn(line));
        }
        names.merge(namesIn(own));
        names.erase(wrong);
        return {names.begin(), names.end()};
    }

    /// The types of parameters that stand in the line of the shader that is wrong.
    [[nodiscard]] std::string parametersAt(const std::string& error, const gl::ShaderSource& source) const {
        const auto origin = std::ranges::find(source.origin, error.substr(0, error.find(errorMark)));
        if (origin == source.origin.end()) return "";
        std::istringstream lines(source.text);
        std::string wrong;
        for (auto i = source.origin.begin(); i <= origin; ++i) std::getline(lines, wrong);
        const std::set<std::string> names = namesIn(wrong);
        std::string types;
        for (const Parameter& parameter : folder_.entry.parameters)
            if (const std::string macro = macroOf(parameter.name); names.contains(macro)) types += typeOf(parameter, macro);
        return types;
    }

    /// "" of one with choices that are no numbers: it has no macro of its name alone.
    [[nodiscard]] std::string typeOf(const Parameter& parameter, const std::string& macro) const {
        const auto value = std::ranges::find(defines_, macro, &gl::Defines::value_type::first);
        if (value == defines_.end()) return "";
        const bool isReal = std::holds_alternative<RealRange>(parameter.domain);
        const std::string is = fmt::format("; {} is {} {}", macro, isReal ? "the float" : "the int", value->second);
        const auto place = folder_.places.find("parameter." + parameter.name);
        if (place == folder_.places.end()) return is;
        return fmt::format("{}, as {} at {} has a decimal point", is, isReal ? "a number" : "no number", place->second);
    }

    const TechniqueFolder& folder_;
    const FolderPass& pass_;
    const gl::Defines& defines_;
};

} // namespace

std::string compileError(const TechniqueFolder& folder, const FolderPass& pass, const gl::Defines& defines,
                         const std::string& log) {
    return CompileError(folder, pass, defines).firstIn(log);
}

} // namespace shadowbench::techniques
