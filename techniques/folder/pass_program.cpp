#include "techniques/folder/pass_program.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/words.h"
#include "techniques/folder/inputs.h"
#include "techniques/folder/patterns.h"
#include "techniques/folder/reading.h"
#include "techniques/shared/maps/normal_offset.h"

#include <algorithm>
#include <fmt/format.h>
#include <regex>
#include <sstream>

namespace shadowbench::techniques {
namespace {

/// A parameter is a macro by its name in capitals; a choice is one of name and word.
gl::Defines definesOf(const TechniqueFolder& folder, const Parameters& values) {
    gl::Defines defines = JitterTable::defines();
    if (folder.mapParameters == MapParameters::AnyBias)
        for (auto& define : normalOffsetDefines(biasFrom(values))) defines.push_back(std::move(define));
    for (const Parameter& parameter : folder.entry.parameters) {
        const std::string& value = values.text(parameter.name);
        if (const auto* words = std::get_if<OneOf>(&parameter.domain)) {
            defines.emplace_back(macroOf(parameter.name + "_" + value), "1");
            if (areNumbers(*words)) defines.emplace_back(macroOf(parameter.name), value);
        } else if (std::holds_alternative<RealRange>(parameter.domain))
            defines.emplace_back(macroOf(parameter.name), fmt::format("{:#.9g}", values.real(parameter.name)));
        else
            defines.emplace_back(macroOf(parameter.name), value);
    }
    return defines;
}

class PassProgram {
public:
    PassProgram(const TechniqueFolder& folder, const FolderPass& pass, const Parameters& values)
        : folder_(folder), pass_(pass), values_(values) {}

    [[nodiscard]] gl::Program made(const gl::Defines& defines) const {
        const std::string vertex = pass_.casters ? "folder/casters.vert" : "gl/screen.vert";
        try {
            gl::Program program =
                gl::Program::ofFolder(vertex, {folder_.path.string(), folder_.shaders}, pass_.fragment, defines);
            for (const auto& [name, type] : program.uniformTypes()) requireKnown(name, type);
            return program;
        } catch (const InternalError& error) {
            throw BadInput(firstErrorIn(error.what()));
        }
    }

private:
    [[nodiscard]] std::string file() const { return gl::placeOf({folder_.path.string(), folder_.shaders}, pass_.fragment); }

    /// The line of the compiler's log that is the first error, where warnings may come before; of the linker's, after the
    /// file.
    [[nodiscard]] std::string firstErrorIn(const std::string& text) const {
        std::istringstream lines(text);
        std::string first;
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("0:0(0)")) line = file() + line.substr(6); // of the file as a whole
            const std::size_t link = line.starts_with("linking ") ? line.find(" failed: ") : std::string::npos;
            if (link != std::string::npos) line = fmt::format("{}: {}", file(), line.substr(link + 9));
            if (line.find(": error: ") != std::string::npos || line.find("preprocessor error: ") != std::string::npos)
                return line;
            if (first.empty() && !line.starts_with("compiling ")) first = line;
        }
        return first;
    }

    /// Where a file of the folder declares a uniform: the pass's own first.
    [[nodiscard]] std::string placeOf(const std::string& uniform) const {
        const std::regex declaration("\\buniform\\b.*\\b" + uniform + "\\b");
        std::vector<std::string> names;
        if (folder_.shaders.contains(pass_.fragment)) names.push_back(pass_.fragment);
        for (const auto& [name, text] : folder_.shaders) names.push_back(name);
        for (const std::string& name : names) {
            std::istringstream lines(folder_.shaders.at(name));
            std::string line;
            for (int number = 1; std::getline(lines, line); ++number)
                if (line.size() < 1000 && std::regex_search(line, declaration)) // regex recurses by the character
                    return fmt::format("{}/{}:{}", folder_.path.string(), name, number);
        }
        return file();
    }

    [[noreturn]] void fail(const std::string& uniform, const std::string& sentence) const {
        throw BadInput(fmt::format("{}: {}", placeOf(uniform), sentence));
    }

    /// All but what the program sets by itself for casters.
    void requireKnown(const std::string& name, const std::string& type) const {
        if (pass_.casters && (name == "clipFromWorld" || name == "lightPlane")) return;
        if (const auto input = std::ranges::find(folderInputs(), name, &FolderInput::name); input != folderInputs().end())
            return requireInput(name, type, *input);
        const auto pattern = std::ranges::find(folder_.patterns, name, &FolderPattern::name);
        if (pattern != folder_.patterns.end()) return requireType(name, type, typeOf(pattern->kind));
        const FolderTarget* target = targetOf(name);
        if (target == nullptr)
            fail(name, fmt::format("nothing sets the uniform \"{}\"{}; parameters are macros in capitals", name,
                                   didYouMean(name, knownNames())));
        requireType(name, type,
                    target->compare                        ? "sampler2DShadow"
                    : target->format == gl::Format::RG32UI ? "usampler2D"
                                                           : "sampler2D");
        if (isLeftOut(folder_, *target, values_))
            fail(name,
                 fmt::format("the pass \"{}\" reads {}, which no pass writes with these parameters", pass_.name, name));
        if (std::ranges::find(pass_.to, name) != pass_.to.end())
            fail(name, fmt::format("the pass \"{}\" reads {}, which it writes; write another target", pass_.name, name));
    }

    /// Casters are drawn into one view at a time; other passes read all.
    void requireInput(const std::string& name, const std::string& type, const FolderInput& input) const {
        if (name == "sliceEnds" && folder_.view != FolderView::Cascades)
            fail(name, "is of cascades: say view = \"cascades\"");
        if (pass_.casters && input.type.ends_with("[]"))
            fail(name, fmt::format("\"{}\" is of passes over the screen; casters are drawn into one view at a time", name));
        const bool several = folder_.view == FolderView::Cube || folder_.view == FolderView::Cascades;
        const std::string each = std::string(input.type) + (input.ofEachView && several && !pass_.casters ? "[]" : "");
        requireType(name, type, each);
    }

    void requireType(const std::string& name, const std::string& type, std::string_view right) const {
        if (type != right)
            fail(name, fmt::format("the uniform \"{}\" is {}{}", name, right, type.empty() ? "" : ", not " + type));
    }

    /// Whose texels the sampler has, of this frame or the one before.
    [[nodiscard]] const FolderTarget* targetOf(const std::string& sampler) const {
        for (const FolderTarget& target : folder_.targets)
            if (sampler == target.name || (target.history && sampler == std::string(historyPrefix) + target.name))
                return &target;
        return nullptr;
    }

    [[nodiscard]] std::vector<std::string> knownNames() const {
        std::vector<std::string> known;
        for (const FolderInput& input : folderInputs()) known.emplace_back(input.name);
        for (const FolderPattern& pattern : folder_.patterns) known.push_back(pattern.name);
        for (const FolderTarget& target : folder_.targets) {
            known.push_back(target.name);
            if (target.history) known.push_back(std::string(historyPrefix) + target.name);
        }
        return known;
    }

    const TechniqueFolder& folder_;
    const FolderPass& pass_;
    const Parameters& values_;
};

std::string text(const Amount& amount) {
    return std::visit([](const auto& value) { return fmt::format("{}", value); }, amount);
}

/// One that includes what is not there has no other text than its own.
std::string shaderText(const TechniqueFolder& folder, const FolderPass& pass) {
    if (pass.fragment.empty()) return "";
    try {
        return gl::loadShader({"", folder.shaders}, pass.fragment, pass.defines).text;
    } catch (const InternalError&) {
        const auto own = folder.shaders.find(pass.fragment);
        return own == folder.shaders.end() ? pass.fragment : own->second;
    }
}

std::string stateOf(const TechniqueFolder& folder, const FolderPass& pass) {
    const glm::vec4 clear = pass.clear.value_or(glm::vec4(-1));
    std::string state = fmt::format(
        "{} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", pass.casters, static_cast<int>(pass.bias), pass.peels,
        pass.when ? pass.when->parameter + "=" + pass.when->word : "", text(pass.slopeOffset), text(pass.unitOffset),
        pass.clear.has_value(), clear.x, clear.y, clear.z, clear.w, pass.blend ? static_cast<int>(*pass.blend) : -1,
        static_cast<int>(pass.cull), pass.depthTest, text(pass.repeat));
    if (pass.casters) {
        const FolderCascades& cascades = folder.cascades;
        state +=
            fmt::format("\n{} {} {} {} {} {} {}", static_cast<int>(folder.view), text(cascades.count), text(cascades.lambda),
                        text(cascades.blend), cascades.fit.text, cascades.warp.text, cascades.stable.text);
    }
    for (const FolderTarget& target : folder.targets)
        if (std::ranges::count(pass.to, target.name) > 0)
            state +=
                fmt::format("\n{} {} {} {} {} {} {} {}{}", target.linearWhen ? target.linearWhen->word : "", target.name,
                            static_cast<int>(target.format), target.ofImage, text(target.side), target.linear,
                            target.compare, target.mipmaps, target.chosen.empty() ? "" : " " + target.chosen);
    return state;
}

} // namespace

std::map<std::string, std::string> passHashes(const TechniqueFolder& folder) {
    std::map<std::string, std::string> texts, hashes;
    for (const FolderPass& pass : folder.passes)
        texts[pass.name] += stateOf(folder, pass) + "\n" + shaderText(folder, pass) + "\n";
    for (const auto& [name, all] : texts) hashes[name] = hash128(all).text();
    return hashes;
}

gl::Program programOf(const TechniqueFolder& folder, const FolderPass& pass, const Parameters& values, int views) {
    if (pass.fragment.empty()) return {"shared/maps/depth_map.vert", "gl/depth_only.frag"};
    gl::Defines defines = definesOf(folder, values);
    defines.emplace_back("TILES", std::to_string(views));
    defines.insert(defines.end(), pass.defines.begin(), pass.defines.end());
    return PassProgram(folder, pass, values).made(defines);
}

} // namespace shadowbench::techniques
