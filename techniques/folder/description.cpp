#include "techniques/folder/description.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/one_line.h"
#include "base/toml_value.h"
#include "base/words.h"
#include "techniques/folder/inputs.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace shadowbench::techniques {
namespace {

namespace fs = std::filesystem;

constexpr const char* description = "technique.toml";
constexpr int mostTargets = 32, mostPasses = 64, mostParameters = 32, mostVariants = 32;
constexpr std::size_t mostFiles = 64, mostBytes = 1 << 20; // of a file

constexpr Words<gl::Format, 8> formats{"format",
                                       {{{gl::Format::R8, "R8"},
                                         {gl::Format::RGBA8, "RGBA8"},
                                         {gl::Format::R32F, "R32F"},
                                         {gl::Format::RG16F, "RG16F"},
                                         {gl::Format::RG32F, "RG32F"},
                                         {gl::Format::RGBA16F, "RGBA16F"},
                                         {gl::Format::RGBA32F, "RGBA32F"},
                                         {gl::Format::Depth32F, "Depth32F"}}}};
constexpr Words<Answer, 3> answers{"answer",
                                   {{{Answer::Hard, "hard"}, {Answer::Filtered, "filtered"}, {Answer::Soft, "soft"}}}};
constexpr Words<FolderView, 3> views{
    "view", {{{FolderView::Scene, "scene"}, {FolderView::Focused, "focused"}, {FolderView::Sample, "light-sample"}}}};

/// A name that GLSL takes, too.
std::string identifier(const TomlValue& value, const std::string& name) {
    const auto allowed = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    if (name.empty() || name.size() > 40 || std::isalpha(static_cast<unsigned char>(name.front())) == 0 ||
        !std::ranges::all_of(name, allowed) || name.starts_with("gl_") || name.find("__") != std::string::npos)
        value.fail(fmt::format("\"{}\" is no name in GLSL: a letter, then letters, digits and _, 40 at most", name));
    return name;
}

/// For people, so there is one.
std::string words(const TomlValue& value) {
    std::string text = value.text();
    if (text.empty()) value.fail("is empty; say it in a few words");
    if (onOneLine(text) != text) value.fail("has line ends or other control characters; say it in one line");
    return text;
}

/// Calls `read`; BadInput of it, which knows no place, is of `value`.
template <class Read>
auto at(const TomlValue& value, const Read& read) {
    try {
        return read();
    } catch (const BadInput& error) {
        value.fail(error.what());
    }
}

class Reader {
public:
    Reader(const std::string& toml, fs::path folder, gl::ShaderFiles shaders)
        : folder_(std::move(folder)), file_(folder_ / description), toml_(toml) {
        read_.path = folder_;
        read_.shaders = std::move(shaders);
        std::string all;
        for (const auto& [name, text] : read_.shaders) all += fmt::format("{} {}\n{}\n", name, text.size(), text);
        read_.entry.digest = hash128(toml_ + all).text();
    }

    TechniqueFolder read() {
        const TomlSource source{.file = file_.string(), .largest = 1e18}; // GLSL holds its square
        const toml::table table = parseToml(toml_, file_.string());
        const TomlValue root(source, "", table);
        root.only(
            {"id", "title", "source", "answer", "history", "view", "variants", "lacks", "parameter", "target", "pass"});
        readFacts(root);
        if (const auto parameters = root.find("parameter"))
            for (const TomlValue& value : members(*parameters, mostParameters)) readParameter(value);
        if (const auto targets = root.find("target"))
            for (const TomlValue& value : members(*targets, mostTargets)) readTarget(value);
        const std::vector<TomlValue> passes = root.get("pass").list();
        if (passes.empty() || passes.size() > mostPasses)
            root.get("pass").fail(fmt::format("expected 1 to {} of them, got {}", mostPasses, passes.size()));
        for (const TomlValue& value : passes) readPass(value);
        if (read_.passes.back().to != std::vector<std::string>{visibilityTarget})
            passes.back().fail(R"(the last pass writes the answer: to = "visibility")");
        readVariants(root);
        return std::move(read_);
    }

private:
    void readFacts(const TomlValue& root) {
        Entry& entry = read_.entry;
        const std::string id = root.get("id").text();
        if (!isFolderId(id))
            root.get("id").fail(fmt::format("\"{}\" is no id: lower-case letters, digits and -, 40 at most", id));
        entry.id = std::string(folderPrefix) + id;
        entry.title = words(root.get("title"));
        entry.source = Source{Document::Other, root.find("source") ? words(root.get("source")) : std::string()};
        entry.answer = answers.named(root.get("answer").oneOf(answers.all()));
        entry.temporal = root.find("history") && root.get("history").boolean();
        if (const auto view = root.find("view")) read_.view = views.named(view->oneOf(views.all()));
        if (read_.view == FolderView::Sample && entry.answer != Answer::Soft)
            root.get("view").fail("a light-sample is of a technique whose answer is soft");
        if (const auto lacks = root.find("lacks"))
            for (const TomlValue& value : lacks->list())
                entry.lacks.insert(at(value, [name = value.text()] { return needNamed(name); }));
    }

    static std::vector<TomlValue> members(const TomlValue& table, std::size_t most) {
        std::vector<TomlValue> all = table.members();
        if (all.size() > most) table.fail(fmt::format("has {} entries; {} are allowed", all.size(), most));
        return all;
    }

    void readParameter(const TomlValue& value) {
        value.only({"default", "range", "choices", "meaning", "source"});
        Parameter parameter{identifier(value, std::string(value.lastKey())),
                            value.get("default").scalar(),
                            {},
                            words(value.get("meaning")),
                            value.find("source") ? words(value.get("source")) : std::string()};
        if (const auto choices = value.find("choices")) {
            OneOf named;
            for (const TomlValue& word : choices->list()) {
                if (std::ranges::count(named.values, word.text()) > 0) word.fail("is there twice");
                named.values.push_back(identifier(word, word.text()));
            }
            if (named.values.empty()) choices->fail("names no word; of a number, say its range");
            value.get("default").oneOf(named.values);
            parameter.domain = named;
        } else {
            parameter.domain = rangeOf(value);
        }
        for (const Parameter& other : read_.entry.parameters)
            for (const std::string& macro : macrosOf(parameter))
                if (std::ranges::count(macrosOf(other), macro) > 0)
                    value.fail(fmt::format("shaders would call it {}, as {}; rename one", macro, other.name));
        read_.entry.parameters.push_back(std::move(parameter));
    }

    static std::vector<std::string> macrosOf(const Parameter& parameter) {
        const auto* choices = std::get_if<OneOf>(&parameter.domain);
        if (choices == nullptr) return {macroOf(parameter.name)};
        std::vector<std::string> macros;
        for (const std::string& word : choices->values) macros.push_back(macroOf(parameter.name + "_" + word));
        return macros;
    }

    /// Of whole numbers if none of the three has a decimal point.
    static Domain rangeOf(const TomlValue& value) {
        const std::vector<TomlValue> ends = value.get("range").list();
        if (ends.size() != 2) value.get("range").fail("expected [least, most], or `choices` in its place");
        const TomlValue standard = value.get("default");
        const double low = ends[0].number(), high = ends[1].number(), usual = standard.number();
        if (low > high) value.get("range").fail("its first number is above its second");
        if (usual < low || usual > high) standard.fail(fmt::format("is not within [{}, {}]", low, high));
        if (!ends[0].isWhole() || !ends[1].isWhole() || !standard.isWhole()) return RealRange{low, high};
        constexpr int most = 1 << 30;
        return IntegerRange{ends[0].integer(-most, most), ends[1].integer(-most, most)};
    }

    const Parameter* parameterNamed(const std::string& name) const {
        const auto found = std::ranges::find(read_.entry.parameters, name, &Parameter::name);
        return found == read_.entry.parameters.end() ? nullptr : &*found;
    }

    /// A number, or a parameter that is one.
    Amount amount(const TomlValue& value) const {
        if (!value.isText()) return value.number();
        const Parameter* parameter = parameterNamed(value.text());
        if (parameter == nullptr || std::holds_alternative<OneOf>(parameter->domain)) {
            std::vector<std::string> names;
            for (const Parameter& p : read_.entry.parameters) names.push_back(p.name);
            value.fail(
                fmt::format("\"{}\" is no parameter that is a number{}", value.text(), didYouMean(value.text(), names)));
        }
        return value.text();
    }

    void readTarget(const TomlValue& value) {
        value.only({"format", "size", "filter", "compare", "mipmaps", "history"});
        const auto flag = [&](const char* key) { return value.find(key) && value.get(key).boolean(); };
        FolderTarget target{.name = identifier(value, std::string(value.lastKey())),
                            .format = formats.named(value.get("format").oneOf(formats.all())),
                            .linear = value.find("filter") && value.get("filter").oneOf({"nearest", "linear"}) == "linear",
                            .compare = flag("compare"),
                            .mipmaps = flag("mipmaps"),
                            .history = flag("history")};
        if (target.name == visibilityTarget) value.fail("is the image of the answer, which is there already");
        if (std::ranges::count(folderInputs(), target.name, &FolderInput::name) > 0 ||
            target.name.starts_with(historyPrefix))
            value.fail("is the name of a uniform that shaders have already; choose another");
        const TomlValue size = value.get("size");
        target.ofImage = size.isText() && size.text() == "image";
        if (!target.ofImage && !size.isText() && !size.isWhole())
            size.fail("expected \"image\", a whole number of texels per side, or the parameter that has it");
        if (!target.ofImage) target.side = amount(size);
        if (const double* texels = std::get_if<double>(&target.side); !target.ofImage && texels != nullptr)
            target.side = static_cast<double>(size.integer(1, mostTexelsOfSide));
        if (target.compare && target.format != gl::Format::Depth32F)
            value.fail("only depths compare: format = \"Depth32F\"");
        if (target.mipmaps && target.format == gl::Format::Depth32F) value.fail("depths have no mipmaps");
        if (target.history && !read_.entry.temporal)
            value.fail("keeps texels of the frame before: say history = true above");
        read_.targets.push_back(std::move(target));
    }

    [[nodiscard]] const FolderTarget* targetNamed(const std::string& name) const {
        const auto found = std::ranges::find(read_.targets, name, &FolderTarget::name);
        return found == read_.targets.end() ? nullptr : &*found;
    }

    void readPass(const TomlValue& value) {
        value.only({"name", "draw", "fragment", "to", "define", "offset", "clear"});
        FolderPass pass;
        pass.name = words(value.get("name"));
        pass.casters = value.get("draw").oneOf({"casters", "screen"}) == "casters";
        const TomlValue to = value.get("to");
        if (to.isList())
            for (const TomlValue& name : to.list()) addTarget(pass, name);
        else
            addTarget(pass, to);
        if (pass.to.empty()) to.fail("names no target");
        if (const auto fragment = value.find("fragment")) {
            pass.fragment = fragment->text();
            if (!read_.shaders.contains(pass.fragment)) fragment->fail(noShader(pass.fragment));
        } else if (!pass.casters) {
            value.fail("a pass over the screen needs a fragment shader: fragment = \"resolve.frag\"");
        }
        if (const auto defines = value.find("define"))
            for (const TomlValue& define : defines->members()) addDefine(pass, define);
        readCasters(value, pass);
        read_.passes.push_back(std::move(pass));
    }

    void addDefine(FolderPass& pass, const TomlValue& value) const {
        const std::string name = identifier(value, std::string(value.lastKey())), text = value.scalar();
        if (onOneLine(text) != text) value.fail("has line ends or other control characters; a macro is one line");
        for (const Parameter& parameter : read_.entry.parameters)
            if (std::ranges::count(macrosOf(parameter), name) > 0)
                value.fail(fmt::format("is the parameter {} already; choose another name", parameter.name));
        pass.defines.emplace_back(name, text);
    }

    [[nodiscard]] std::string noShader(const std::string& name) const {
        std::vector<std::string> names;
        for (const auto& [file, text] : read_.shaders) names.push_back(file);
        return fmt::format("{} has no shader \"{}\"{}", folder_.string(), name, didYouMean(name, names));
    }

    void addTarget(FolderPass& pass, const TomlValue& value) {
        const std::string name = value.text();
        const FolderTarget* target = targetNamed(name);
        if (target == nullptr && name != visibilityTarget) {
            std::vector<std::string> names{visibilityTarget};
            for (const FolderTarget& known : read_.targets) names.push_back(known.name);
            value.fail(fmt::format("there is no target \"{}\"{}", name, didYouMean(name, names)));
        }
        if (std::ranges::find(pass.to, name) != pass.to.end()) value.fail("is written twice");
        if (!pass.to.empty()) {
            const FolderTarget* first = targetNamed(pass.to.front());
            if (target == nullptr || first == nullptr) value.fail("visibility is written alone");
            if (target->ofImage != first->ofImage || target->side != first->side)
                value.fail(fmt::format("is of another size than {}; what a pass writes is of one size", first->name));
        }
        pass.to.push_back(name);
    }

    void readCasters(const TomlValue& value, FolderPass& pass) {
        const auto isDepth = [&](const std::string& name) {
            const FolderTarget* target = targetNamed(name);
            return target != nullptr && target->format == gl::Format::Depth32F;
        };
        const auto depths = std::ranges::count_if(pass.to, isDepth);
        if (pass.casters) {
            if (depths > 1) value.fail("one target of depths is all that a pass has");
            if (pass.to.front() == visibilityTarget || targetNamed(pass.to.front())->ofImage)
                value.fail("casters are drawn into a map, which has a size of its own");
            if (pass.fragment.empty() && std::ssize(pass.to) > depths) value.fail("colours need a fragment shader");
        } else if (depths > 0) {
            value.fail("a pass over the screen writes no depths");
        }
        const auto offset = value.find("offset");
        const auto clear = value.find("clear");
        if (!pass.casters && (offset || clear)) value.fail("offset and clear are of casters");
        if (offset) {
            const std::vector<TomlValue> both = offset->list();
            if (both.size() != 2) offset->fail("expected [of the slope, units], numbers or parameters");
            pass.slopeOffset = amount(both[0]);
            pass.unitOffset = amount(both[1]);
        }
        if (clear) {
            const std::vector<TomlValue> four = clear->list();
            if (four.size() != 4) clear->fail("expected four numbers");
            for (int i = 0; i < 4; ++i) pass.clear[i] = static_cast<float>(four[static_cast<std::size_t>(i)].number());
        }
    }

    void readVariants(const TomlValue& root) {
        Entry& entry = read_.entry;
        const auto listed = root.find("variants");
        if (!listed) entry.variants = {""};
        for (const TomlValue& value : listed ? listed->list() : std::vector<TomlValue>()) {
            entry.variants.push_back(value.text());
            at(value, [&] { return parseParameters(entry.variants.back(), entry.parameters, entry.id); });
        }
        if (entry.variants.empty() || entry.variants.size() > mostVariants)
            listed->fail(fmt::format("expected 1 to {} texts, got {}; \"\" is the row of all defaults", mostVariants,
                                     entry.variants.size()));
    }

    fs::path folder_, file_;
    std::string toml_;
    TechniqueFolder read_;
};

std::string textOf(const fs::directory_entry& entry) {
    const std::string file = entry.path().string();
    if (entry.is_symlink() || !entry.is_regular_file())
        throw BadInput(fmt::format("{} is no file of the folder but a link, a folder or a device; copy the file", file));
    if (entry.file_size() > mostBytes) throw BadInput(fmt::format("{} is larger than 1 MiB, which is the most", file));
    std::string text = readFile(entry.path());
    if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n');
        throw BadInput(fmt::format("{}:{}: has a byte 0, so it is no text", file, line));
    }
    return text;
}

/// Of the folder alone, none of those that it links to; what is no shader is left alone.
gl::ShaderFiles shadersIn(const fs::path& folder) {
    gl::ShaderFiles shaders;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending == ".glsl" || ending == ".frag") shaders[entry.path().filename().string()] = textOf(entry);
        if (shaders.size() > mostFiles)
            throw BadInput(fmt::format("{} has more than {} shaders", folder.string(), mostFiles));
    }
    return shaders;
}

} // namespace

std::string macroOf(std::string name) {
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return name;
}

bool isFolderId(std::string_view id) {
    const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
    return !id.empty() && id.size() <= 40 && std::ranges::all_of(id, allowed);
}

TechniqueFolder parseTechniqueFolder(const std::string& toml, const fs::path& folder, gl::ShaderFiles shaders) {
    return Reader(toml, folder, std::move(shaders)).read();
}

TechniqueFolder readTechniqueFolder(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw BadInput(
            fmt::format("there is no technique folder {}; it holds a technique.toml and its shaders", folder.string()));
    const fs::path file = folder / description;
    try {
        if (!fs::exists(fs::symlink_status(file)))
            throw BadInput(fmt::format("{} is missing; shadowbench new-technique writes one", file.string()));
        return parseTechniqueFolder(textOf(fs::directory_entry(file)), folder, shadersIn(folder));
    } catch (const fs::filesystem_error& error) {
        throw BadInput(fmt::format("cannot read the folder {}: {}", folder.string(), error.code().message()));
    }
}

} // namespace shadowbench::techniques
