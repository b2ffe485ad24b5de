#include "techniques/folder/pass_program.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/memory.h"
#include "base/memory_bound.h"
#include "base/pattern.h"
#include "base/words.h"
#include "techniques/folder/compile_error.h"
#include "techniques/folder/inputs.h"
#include "techniques/folder/patterns.h"
#include "techniques/folder/reading.h"
#include "techniques/folder/vocabulary.h"
#include "techniques/shared/maps/normal_offset.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <new>
#include <sstream>

namespace shadowbench::techniques {
namespace {

/// Of Mesa's compiler, for one program: a hundred times what the largest of ours needs. Macros and functions that call each
/// other twice would take what there is.
constexpr std::uint64_t compilersMemory = std::uint64_t{1} << 30;

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

/// Of `target`; null: of visibility.
std::string imageType(const FolderTarget* target) {
    return target != nullptr && target->format == gl::Format::RG32UI ? "uimage2D" : "image2D";
}

class PassProgram {
public:
    PassProgram(const TechniqueFolder& folder, const FolderPass& pass, const Parameters& values)
        : folder_(folder), pass_(pass), values_(values) {}

    [[nodiscard]] gl::Program made(const gl::Defines& defines) const {
        try {
            const MemoryBound bound(compilersMemory, tooLarge());
            gl::Program program = linked(defines);
            const auto types = program.uniformTypes();
            for (const auto& [name, type] : types) requireKnown(name, type);
            if (pass_.kind == PassKind::Compute)
                requireStores(types);
            else
                requireOutputs(program.outputs());
            return program;
        } catch (const InternalError& error) {
            throw BadInput(compileError(folder_, pass_, defines, error.what()));
        } catch (const std::bad_alloc&) {
            throw BadInput(tooLarge());
        }
    }

private:
    [[nodiscard]] gl::Program linked(const gl::Defines& defines) const {
        const gl::ShaderFolder folder{folder_.path.string(), folder_.shaders};
        if (pass_.kind == PassKind::Compute) return gl::Program::computeOfFolder(folder, pass_.shader, defines);
        const char* vertex = pass_.kind == PassKind::Casters ? "folder/casters.vert" : "gl/screen.vert";
        return gl::Program::ofFolder(vertex, folder, pass_.shader, defines);
    }

    [[nodiscard]] std::string tooLarge() const {
        return fmt::format(
            "{}: compiling it takes more than {} of memory, or nests deeper than its stack: let its macros and "
            "functions expand to less",
            file(), inBytes(compilersMemory));
    }

    /// Of a compute pass: that it can store into all targets, and has the targets that its groups are counted by.
    void requireStores(const std::map<std::string, std::string>& types) const {
        for (const std::string& name : pass_.to)
            if (!types.contains(name))
                throw BadInput(
                    fmt::format("{}: the pass \"{}\" writes {}, but its shader stores into no such image: declare "
                                "writeonly uniform {} {};",
                                file(), pass_.name, name, imageType(targetOf(name)), name));
        for (const GroupCount& count : pass_.groups)
            if (const auto* name = std::get_if<std::string>(&count);
                name != nullptr && isLeftOut(folder_, *targetOf(*name), values_))
                throw BadInput(
                    fmt::format("{}: the pass \"{}\" has a work group for each texel of {}, which no pass writes with "
                                "these parameters: say another target or a number",
                                (folder_.path / "technique.toml").string(), pass_.name, *name));
    }

    /// What no output is written to would hold anything.
    void requireOutputs(int outputs) const {
        const auto colours = std::ranges::count_if(pass_.to, [&](const std::string& name) {
            const FolderTarget* target = targetOf(name);
            return target == nullptr || !isDepth(target->format);
        });
        if (outputs < colours)
            throw BadInput(
                fmt::format("{}: the pass \"{}\" writes {}, and its shader writes {} outputs: declare an `out` for "
                            "each, in their order, and write it",
                            file(), pass_.name, fmt::join(pass_.to, ", "), outputs));
    }

    [[nodiscard]] std::string file() const { return gl::placeOf({folder_.path.string(), folder_.shaders}, pass_.shader); }

    struct Declaration {
        std::string place; // file and line
        std::string line;  // empty where none was found
    };

    /// Where a file of the folder declares a uniform: the pass's own first.
    [[nodiscard]] Declaration declarationOf(const std::string& uniform) const {
        const std::string declaration = "\\buniform\\b.*\\b" + uniform + "\\b";
        std::vector<std::string> names;
        if (folder_.shaders.contains(pass_.shader)) names.push_back(pass_.shader);
        for (const auto& [name, text] : folder_.shaders) names.push_back(name);
        for (const std::string& name : names) {
            std::istringstream lines(folder_.shaders.at(name));
            std::string line;
            for (int number = 1; std::getline(lines, line); ++number)
                if (!firstMatch(line, declaration).empty())
                    return {fmt::format("{}/{}:{}", folder_.path.string(), name, number), line};
        }
        return {file(), ""};
    }

    [[noreturn]] void fail(const std::string& uniform, const std::string& sentence) const {
        throw BadInput(fmt::format("{}: {}", declarationOf(uniform).place, sentence));
    }

    /// All but what the program sets by itself for casters.
    void requireKnown(const std::string& name, const std::string& type) const {
        if (isImage(type)) return requireImage(name, type);
        if (pass_.kind == PassKind::Casters && (name == "clipFromWorld" || name == "lightPlane")) return;
        if (const auto input = std::ranges::find(folderInputs(), name, &FolderInput::name); input != folderInputs().end())
            return requireInput(name, type, *input);
        const auto pattern = std::ranges::find(folder_.patterns, name, &FolderPattern::name);
        if (pattern != folder_.patterns.end()) return requireType(name, type, typeOf(pattern->kind));
        const FolderTarget* target = targetOf(name);
        if (target == nullptr)
            fail(name, fmt::format("nothing sets the uniform \"{}\"{}; parameters are macros in capitals", name,
                                   didYouMean(name, uniformNames(folder_))));
        requireType(name, type,
                    target->compare                        ? "sampler2DShadow"
                    : target->format == gl::Format::RG32UI ? "usampler2D"
                                                           : "sampler2D");
        if (isLeftOut(folder_, *target, values_))
            fail(name,
                 fmt::format("the pass \"{}\" reads {}, which no pass writes with these parameters", pass_.name, name));
        requireKept(name, *target);
        if (std::ranges::find(pass_.to, name) != pass_.to.end())
            fail(name, fmt::format("the pass \"{}\" reads {}, which it writes; write another target", pass_.name, name));
    }

    /// Those that a pass stores into are all the images that there are. What they were is not read: their format is the
    /// target's, which the shader need not say then.
    void requireImage(const std::string& name, const std::string& type) const {
        if (pass_.kind != PassKind::Compute) fail(name, "images are stored into by compute passes alone: declare a sampler");
        if (std::ranges::count(pass_.to, name) == 0)
            fail(name, fmt::format("the pass \"{}\" does not write {}{}: name it in `to`", pass_.name, name,
                                   didYouMean(name, pass_.to)));
        requireType(name, type, imageType(targetOf(name)));
        const std::string line = declarationOf(name).line;
        if (!line.empty() && line.find("writeonly") == std::string::npos)
            fail(name, fmt::format("images are written alone: declare writeonly uniform {} {};", type, name));
    }

    /// Casters are drawn into one view at a time; other passes read all.
    void requireInput(const std::string& name, const std::string& type, const FolderInput& input) const {
        const FolderView view = viewOf(folder_, values_);
        if (name == "sliceEnds" && view != FolderView::Cascades) fail(name, "is of cascades: say view = \"cascades\"");
        if (pass_.kind == PassKind::Casters && input.type.ends_with("[]"))
            fail(name, fmt::format("\"{}\" is of passes over the screen; casters are drawn into one view at a time", name));
        if (pass_.once && input.of == InputOf::Frame)
            fail(name,
                 fmt::format("\"{}\" changes from frame to frame, and the pass \"{}\" is drawn once: leave one of the two "
                             "out",
                             name, pass_.name));
        const bool several = view == FolderView::Cube || view == FolderView::Cascades;
        const std::string each = std::string(input.type) +
                                 (input.of == InputOf::EachView && several && pass_.kind != PassKind::Casters ? "[]" : "");
        requireType(name, type, each);
    }

    void requireType(const std::string& name, const std::string& type, std::string_view right) const {
        if (type != right)
            fail(name, fmt::format("the uniform \"{}\" is {}{}", name, right, type.empty() ? "" : ", not " + type));
    }

    /// What a pass that is drawn once reads is drawn once, too.
    void requireKept(const std::string& sampler, const FolderTarget& target) const {
        const auto isLater = [&](const FolderPass& pass) {
            return !pass.once && std::ranges::count(pass.to, target.name) > 0;
        };
        if (pass_.once && std::ranges::any_of(folder_.passes, isLater))
            fail(sampler, fmt::format("the pass \"{}\" is drawn once, but {} in each frame: say once of both or of none",
                                      pass_.name, target.name));
    }

    /// Whose texels the sampler has, of this frame or the one before.
    [[nodiscard]] const FolderTarget* targetOf(const std::string& sampler) const {
        for (const FolderTarget& target : folder_.targets)
            if (sampler == target.name || (target.history && sampler == std::string(historyPrefix) + target.name))
                return &target;
        return nullptr;
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
    if (pass.shader.empty()) return "";
    try {
        return gl::loadShader({"", folder.shaders}, pass.shader, pass.defines).text;
    } catch (const InternalError&) {
        const auto own = folder.shaders.find(pass.shader);
        return own == folder.shaders.end() ? pass.shader : own->second;
    }
}

std::string stateOf(const TechniqueFolder& folder, const FolderPass& pass) {
    const glm::vec4 clear = pass.clear.value_or(glm::vec4(-1));
    std::string state = fmt::format(
        "{} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", pass.kind == PassKind::Casters, static_cast<int>(pass.bias),
        pass.peels, pass.when ? pass.when->parameter + "=" + pass.when->word : "", text(pass.slopeOffset),
        text(pass.unitOffset), pass.clear.has_value(), clear.x, clear.y, clear.z, clear.w,
        pass.blend ? static_cast<int>(*pass.blend) : -1, static_cast<int>(pass.cull), pass.depthTest, text(pass.repeat));
    if (pass.once) state += " once";
    if (const auto& s = pass.stencil)
        state += fmt::format(" {} {} {} {} {}", static_cast<int>(s->test), s->reference, static_cast<int>(s->pass),
                             static_cast<int>(s->depthFail), static_cast<int>(s->fail));
    for (const GroupCount& count : pass.groups)
        state += std::visit([](const auto& value) { return fmt::format(" {}", value); }, count);
    if (pass.kind == PassKind::Casters) {
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

bool isImage(std::string_view type) { return type.starts_with("image2D") || type.starts_with("uimage2D"); }

std::map<std::string, std::string> passHashes(const TechniqueFolder& folder) {
    std::map<std::string, std::string> texts, hashes;
    for (const FolderPass& pass : folder.passes)
        texts[pass.name] += stateOf(folder, pass) + "\n" + shaderText(folder, pass) + "\n";
    for (const auto& [name, all] : texts) hashes[name] = hash128(all).text();
    return hashes;
}

gl::Program programOf(const TechniqueFolder& folder, const FolderPass& pass, const Parameters& values, int views) {
    if (pass.shader.empty()) return {"shared/maps/depth_map.vert", "gl/depth_only.frag"};
    gl::Defines defines = definesOf(folder, values);
    defines.emplace_back("TILES", std::to_string(views));
    defines.insert(defines.end(), pass.defines.begin(), pass.defines.end());
    return PassProgram(folder, pass, values).made(defines);
}

} // namespace shadowbench::techniques
