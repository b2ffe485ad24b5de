#include "base/error.h"
#include "base/words.h"
#include "embedded_shaders.h"
#include "techniques/gl/program.h"

#include <algorithm>
#include <optional>
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

/// The file of a line `#include "file"`, with blanks wherever GLSL's own directives may have them.
std::optional<std::string> includedBy(std::string_view line) {
    const auto skip = [&](std::string_view word) {
        const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
        if (!line.substr(begin).starts_with(word)) return false;
        line.remove_prefix(begin + word.size());
        return true;
    };
    if (!skip("#") || !skip("include") || !skip("\"")) return std::nullopt;
    return std::string(line.substr(0, line.find('"')));
}

/// Collects the lines of a source and of what it includes, each included file once.
class Assembly {
public:
    /// `own`: files that are included before embedded ones of their names; may be null.
    Assembly(const std::string& name, const Defines& defines, const ShaderFolder* own = nullptr) : own_(own) {
        add("#version 450 core", name + ":0");
        for (const auto& [macro, value] : defines) add("#define " + macro + " " + value, name + ":0");
    }

    void appendFile(const std::string& file, const std::string& includedFrom) {
        if (!included_.insert(file).second) return;
        source_.files.insert(own_ != nullptr ? placeOf(*own_, file) : file);
        if (own_ != nullptr && own_->files.contains(file))
            appendText(own_->path + "/" + file, own_->files.at(file));
        else if (own_ != nullptr && !isEmbedded(file))
            throw InternalError(includedFrom + ": there is no shader \"" + file + "\"" + didYouMean(file, includable()) +
                                ", neither in the folder nor among those that come with the program");
        else
            appendText(file, std::string(embeddedText(file, includedFrom)));
    }

    void appendText(const std::string& name, const std::string& text) {
        std::istringstream lines(text);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            const std::string origin = name + ":" + std::to_string(number);
            if (const auto file = includedBy(line))
                appendFile(*file, origin);
            else
                add(line, origin);
        }
    }

    ShaderSource take() { return std::move(source_); }

private:
    void add(const std::string& line, const std::string& origin) {
        source_.text += line + "\n";
        source_.origin.push_back(origin);
    }

    [[nodiscard]] std::vector<std::string> includable() const {
        std::vector<std::string> names;
        for (const auto& [name, text] : own_->files) names.push_back(name);
        for (const embedded::File& file : embedded::shaders()) names.emplace_back(file.path);
        return names;
    }

    const ShaderFolder* own_;
    ShaderSource source_;
    std::set<std::string> included_;
};

} // namespace

std::string placeOf(const ShaderFolder& folder, const std::string& file) {
    return folder.files.contains(file) ? folder.path + "/" + file : file;
}

bool isEmbedded(const std::string& file) {
    return std::ranges::any_of(embedded::shaders(), [&](const auto& f) { return f.path == file; });
}

ShaderFiles embeddedShaders(const std::string& folder) {
    ShaderFiles shaders;
    for (const embedded::File& file : embedded::shaders())
        if (const std::size_t name = file.path.rfind('/') + 1; file.path.substr(0, name) == folder + "/")
            shaders.emplace(file.path.substr(name), file.text);
    return shaders;
}

ShaderSource loadShader(const std::string& file, const Defines& defines) {
    Assembly assembly(file, defines);
    assembly.appendFile(file, "");
    return assembly.take();
}

ShaderSource shaderFromText(const std::string& name, const std::string& text, const Defines& defines) {
    Assembly assembly(name, defines);
    assembly.appendText(name, text);
    return assembly.take();
}

ShaderSource loadShader(const ShaderFolder& folder, const std::string& file, const Defines& defines) {
    Assembly assembly(placeOf(folder, file), defines, &folder);
    assembly.appendFile(file, "");
    return assembly.take();
}

} // namespace shadowbench::gl
