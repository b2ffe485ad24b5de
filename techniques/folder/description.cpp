#include "techniques/folder/description.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/one_line.h"
#include "base/words.h"
#include "techniques/folder/built_in.h"
#include "techniques/folder/inputs.h"
#include "techniques/folder/keys.h"
#include "techniques/folder/reading.h"
#include "techniques/shared/maps/depth_map.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace shadowbench::techniques {
namespace {

namespace fs = std::filesystem;

constexpr const char* description = "technique.toml";
constexpr int mostPatterns = 8, mostTaps = 1024;
constexpr int mostTargets = 32, mostParameters = 32, mostVariants = 32;
constexpr std::size_t mostFiles = 64, mostBytes = 1 << 20; // of a file
constexpr std::size_t mostBytesTogether = 4 << 20;         // which one pass may include

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
        root.only(keysOf(KeyTable::Root));
        readFacts(root);
        if (const auto parameters = root.find("parameter"))
            for (const TomlValue& value : members(*parameters, mostParameters)) {
                readParameter(value);
                keepPlace(value);
            }
        if (const auto row = root.find("parameters_of")) addParametersOf(*row);
        if (const auto map = root.find("depth_map")) addMapParameters(*map);
        readView(root, read_);
        if (const auto patterns = root.find("pattern"))
            for (const TomlValue& value : members(*patterns, mostPatterns)) readPattern(value);
        if (const auto targets = root.find("target"))
            for (const TomlValue& value : members(*targets, mostTargets)) readTarget(value);
        readPasses(root.get("pass"), read_);
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
        if (const auto lacks = root.find("lacks"))
            for (const TomlValue& value : lacks->list())
                entry.lacks.insert(at(value, [name = value.text()] { return needNamed(name); }));
    }

    static std::vector<TomlValue> members(const TomlValue& table, std::size_t most) {
        std::vector<TomlValue> all = table.membersAsWritten();
        if (all.size() > most) table.fail(fmt::format("has {} entries; {} are allowed", all.size(), most));
        return all;
    }

    /// For what is found later.
    void keepPlace(const TomlValue& value) {
        const std::string where = value.where();
        read_.places[value.key()] = where.substr(0, where.size() - value.key().size() - 2);
    }

    void readParameter(const TomlValue& value) {
        value.only(keysOf(KeyTable::Parameter));
        Parameter parameter{identifier(value, std::string(value.lastKey())),
                            value.get("default").scalar(),
                            {},
                            words(value.get("meaning")),
                            value.find("source") ? words(value.get("source")) : std::string()};
        if (const auto choices = value.find("choices")) {
            OneOf named;
            for (const TomlValue& word : choices->list()) {
                if (std::ranges::count(named.values, word.text()) > 0) word.fail("is there twice");
                named.values.push_back(choice(word));
            }
            if (named.values.empty()) choices->fail("names no word; of a number, say its range");
            value.get("default").oneOf(named.values);
            parameter.domain = named;
        } else {
            parameter.domain = rangeOf(value);
        }
        add(std::move(parameter), value);
    }

    /// Those of a row that is built in, its map's left out.
    void addParametersOf(const TomlValue& row) {
        const std::vector<std::string> places = builtInPlaces();
        if (std::ranges::count(places, row.text()) == 0)
            row.fail(
                fmt::format("there is no folder \"{}\" that is built in{}", row.text(), didYouMean(row.text(), places)));
        const TomlSource source{.file = row.text(), .largest = 1e18};
        const toml::table table = parseToml(builtInText(row.text()), row.text());
        if (const auto parameters = TomlValue(source, "", table).find("parameter"))
            for (const TomlValue& value : members(*parameters, mostParameters)) readParameter(value);
    }

    void addMapParameters(const TomlValue& value) {
        read_.mapParameters = mapBiases.named(value.oneOf(mapBiases.all()));
        std::vector<Parameter> parameters = depthMapParameters();
        if (read_.mapParameters == MapParameters::AnyBias) parameters = withNormalOffset(std::move(parameters));
        for (Parameter& parameter : parameters) add(std::move(parameter), value);
    }

    void add(Parameter parameter, const TomlValue& value) {
        for (const std::string& macro : macrosOf(parameter))
            if (macro == "TILES" || macro == "JITTER_BLOCK" || macro == "NORMAL_OFFSET")
                value.fail(fmt::format("shaders have a macro {} already; choose another name", macro));
        for (const Parameter& other : read_.entry.parameters)
            for (const std::string& macro : macrosOf(parameter))
                if (std::ranges::count(macrosOf(other), macro) > 0)
                    value.fail(fmt::format("shaders would call {} {}, as {}; rename one",
                                           value.lastKey() == parameter.name ? "it" : parameter.name, macro, other.name));
        read_.entry.parameters.push_back(std::move(parameter));
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

    void readPattern(const TomlValue& value) {
        value.only(keysOf(KeyTable::Pattern));
        FolderPattern pattern{.name = identifier(value, std::string(value.lastKey())),
                              .kind = patternKinds.named(value.get("kind").oneOf(patternKinds.all()))};
        requireFree(value, pattern.name);
        for (const auto& [key, kind] : {std::pair("sigma", PatternKind::Gaussian), std::pair("taps", PatternKind::Jitter),
                                        std::pair("sectors", PatternKind::Jitter)})
            if (const auto said = value.find(key); said && pattern.kind != kind)
                said->fail(fmt::format("is of a pattern of the kind {}", patternKinds.of(kind)));
        if (pattern.kind == PatternKind::Gaussian)
            pattern.sigma = amountWithin(value.get("sigma"), RealRange{0.01, 1000}, read_);
        if (pattern.kind == PatternKind::Jitter) {
            pattern.taps = tapsOf(value.get("taps"));
            pattern.sectors = value.get("sectors").integer(1, mostTaps);
        }
        read_.patterns.push_back(std::move(pattern));
    }

    /// A number, or a parameter whose words are numbers.
    [[nodiscard]] Amount tapsOf(const TomlValue& value) const {
        const auto parameter =
            std::ranges::find(read_.entry.parameters, value.isText() ? value.text() : "", &Parameter::name);
        const auto* words = parameter == read_.entry.parameters.end() ? nullptr : std::get_if<OneOf>(&parameter->domain);
        if (words == nullptr || !areNumbers(*words)) return amountWithin(value, IntegerRange{2, mostTaps}, read_);
        for (const std::string& word : words->values)
            if (std::stoi(word) < 2 || std::stoi(word) > mostTaps)
                value.fail(fmt::format("{} must be a whole number within 2 and {}", parameter->name, mostTaps));
        return value.text();
    }

    /// Of a uniform that shaders have by this name.
    void requireFree(const TomlValue& value, const std::string& name) const {
        if (name == visibilityTarget) value.fail("is the image of the answer, which is there already");
        if (std::ranges::count(folderInputs(), name, &FolderInput::name) > 0 || name.starts_with(historyPrefix) ||
            std::ranges::count(read_.patterns, name, &FolderPattern::name) > 0)
            value.fail("is the name of a uniform that shaders have already; choose another");
    }

    void readTarget(const TomlValue& value) {
        value.only(keysOf(KeyTable::Target));
        keepPlace(value);
        const auto flag = [&](const char* key) { return value.find(key) && value.get(key).boolean(); };
        FolderTarget target{.name = identifier(value, std::string(value.lastKey())),
                            .format = gl::Format::R8,
                            .linear = value.find("filter") && filters.named(value.get("filter").oneOf(filters.all())),
                            .compare = flag("compare"),
                            .mipmaps = flag("mipmaps"),
                            .history = flag("history")};
        readFormat(value.get("format"), target);
        requireFree(value, target.name);
        if (const auto when = value.find("linear_when")) target.linearWhen = conditionOf(*when, read_);
        if (target.linear && target.linearWhen) value.get("linear_when").fail("is said by filter = \"linear\" already");
        const TomlValue size = value.get("size");
        target.ofImage = size.isText() && size.text() == "image";
        if (!target.ofImage && !size.isText() && !size.isWhole())
            size.fail("expected \"image\", a whole number of texels per side, or the parameter that has it");
        if (!target.ofImage) target.side = amountOf(size, read_);
        if (const double* texels = std::get_if<double>(&target.side); !target.ofImage && texels != nullptr)
            target.side = static_cast<double>(size.integer(1, mostTexelsOfSide));
        if (target.compare && !isDepth(target.format)) value.fail("only depths compare: format = \"Depth32F\"");
        if (target.mipmaps && isDepth(target.format)) value.fail("depths have no mipmaps");
        if ((target.mipmaps || target.linear) && target.format == gl::Format::RG32UI)
            value.fail("whole numbers are not interpolated: leave filter and mipmaps out");
        if (target.history && !read_.entry.temporal)
            value.fail("keeps texels of the frame before: say history = true above");
        read_.targets.push_back(std::move(target));
    }

    /// A word of `formats`, or a parameter whose choices are such.
    void readFormat(const TomlValue& format, FolderTarget& target) const {
        const auto parameter = std::ranges::find(read_.entry.parameters, format.text(), &Parameter::name);
        if (parameter == read_.entry.parameters.end()) {
            target.format = formats.named(format.oneOf(formats.all()));
            return;
        }
        const auto* choices = std::get_if<OneOf>(&parameter->domain);
        if (choices == nullptr) format.fail(fmt::format("{} is a number; its choices would be formats", parameter->name));
        for (const std::string& word : choices->values)
            if (const gl::Format each = at(format, [&] { return formats.named(word); });
                isDepth(each) || each == gl::Format::RG32UI)
                format.fail(fmt::format("{} is none to choose: shaders read it in another way", word));
        target.format = formats.named(parameter->defaultValue);
        target.chosen = parameter->name;
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
    std::size_t bytes = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending == ".glsl" || ending == ".frag" || ending == ".comp")
            bytes += (shaders[entry.path().filename().string()] = textOf(entry)).size();
        if (shaders.size() > mostFiles)
            throw BadInput(fmt::format("{} has more than {} shaders", folder.string(), mostFiles));
        if (bytes > mostBytesTogether)
            throw BadInput(
                fmt::format("the shaders of {} are larger than 4 MiB together, which is the most", folder.string()));
    }
    return shaders;
}

} // namespace

bool isFolderId(std::string_view id) {
    const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
    return !id.empty() && id.size() <= 40 && std::ranges::all_of(id, allowed);
}

gl::Format formatOf(const FolderTarget& target, const Parameters& values) {
    return target.chosen.empty() ? target.format : formats.named(values.text(target.chosen));
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
