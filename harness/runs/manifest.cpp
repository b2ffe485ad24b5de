#include "harness/runs/manifest.h"

#include "base/files.h"
#include "base/hash.h"
#include "base/json_text.h"
#include "groundtruth/store/cache.h"
#include "harness/cells/cell_selection.h"
#include "harness/cells/environment.h"
#include "harness/cells/scene_cells.h"

#include <algorithm>
#include <charconv>
#include <concepts>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace shadowbench::shards {
namespace {

using Json = nlohmann::ordered_json;

/// The shape of a line, once: every key with its member.
void fields(auto&& visit, auto& cell) {
    visit("id", cell.id);
    visit("scene", cell.scene);
    visit("variant", cell.variant);
    visit("profile", cell.profile);
    visit("seed", cell.seed);
    visit("cost", cell.cost);
    visit("images", cell.images);
    visit("commit", cell.commit);
    visit("dirty", cell.dirty);
    visit("program", cell.program);
}

Json toJson(const ManifestCell& cell) {
    Json json;
    fields([&](const char* key, const auto& member) { json[key] = member; }, cell);
    return json;
}

ManifestCell parseCell(const std::string& line) {
    ManifestCell cell;
    const Json json = Json::parse(boundedJson(line, "a line"));
    fields(
        [&](const char* key, auto& member) {
            if constexpr (std::same_as<decltype(member), std::uint32_t&>)
                member = wholeNumber<std::uint32_t>(json.at(key));
            else
                json.at(key).get_to(member);
        },
        cell);
    if (!groundtruth::isKey(cell.id)) throw BadInput("its id is no hash");
    return cell;
}

/// `measured` is what tells one measurement of the cell from another: the record's cell id, or why there is none.
std::string idOf(const ManifestCell& cell, const std::string& measured) {
    const std::string inputs = fmt::format("shard cell 1\n{}\n{}\n{}\nseed {}\ncost {}\n{}\n", cell.scene, cell.variant,
                                           cell.profile, cell.seed, fmt::join(cell.cost, ","), measured);
    return hash128(inputs).text();
}

/// The first member in which two lines differ, in words.
std::string differingMember(const ManifestCell& manifest, const ManifestCell& other) {
    const Json a = toJson(manifest), b = toJson(other);
    for (const auto& [key, value] : a.items())
        if (key != "id" && value != b[key]) return fmt::format("{} is {}, not {}", key, value.dump(), b[key].dump());
    return fmt::format("{} on {} has other inputs: its scene, its truth or a tool of the truth changed", manifest.variant,
                       manifest.scene);
}

std::size_t number(std::string_view text) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

} // namespace

std::vector<std::string> costsOf(const RunOptions& options) {
    std::vector<std::string> cost;
    if (options.measure.time) cost.emplace_back("time");
    if (options.instructions) cost.emplace_back("instructions");
    if (options.measure.otherScreen) cost.emplace_back("screen");
    return cost;
}

bool hasCost(const Record& record, std::string_view kind) {
    if (!wasScored(record.status) || isExternal(record)) return true;
    if (kind == "time") return record.values["cost.time.median"] || record.values["lod.time.median"];
    if (kind == "screen") return record.otherScreen.has_value();
    return record.values["cost.instructions"].has_value();
}

bool hasCosts(const Record& record, const std::vector<std::string>& kinds) {
    return std::ranges::all_of(kinds, [&](const std::string& kind) { return hasCost(record, kind); });
}

std::vector<ManifestCell> plannedCells(const RunOptions& options) {
    const Commit commit = builtFrom();
    ManifestCell cell;
    cell.profile = name(options.profile);
    cell.seed = options.measure.seed;
    cell.cost = costsOf(options);
    cell.images = options.measure.pictures;
    cell.commit = commit.hash;
    cell.dirty = commit.dirty;
    cell.program = programHash();

    const std::vector<techniques::Variant> variants = chosenVariants(options.techniques, options.measure.external.get());
    const groundtruth::Cache noTruths{options.cache}; // ids need the truths' keys only
    std::vector<ManifestCell> cells;
    for (const Scene& scene : chosenScenes(options.scenes, options.profile)) {
        cell.scene = scene.id;
        const SceneCells sceneCells(scene, noTruths, options.measure);
        for (const techniques::Variant& variant : variants) {
            const auto reason = sceneCells.notApplicable(variant);
            cell.variant = variant.name;
            cell.id = idOf(cell, reason ? "not applicable: " + *reason : sceneCells.id(variant));
            cells.push_back(cell);
        }
    }
    return cells;
}

std::filesystem::path manifestFile(const std::filesystem::path& folder) { return folder / "manifest.jsonl"; }

void writeManifest(const std::filesystem::path& folder, const std::vector<ManifestCell>& cells) {
    std::string lines;
    for (const ManifestCell& cell : cells) lines += toJson(cell).dump() + "\n";
    writeFile(manifestFile(folder), lines);
}

std::vector<ManifestCell> readManifest(const std::filesystem::path& folder) {
    const std::filesystem::path file = manifestFile(folder);
    std::istringstream lines(readFile(file));
    std::vector<ManifestCell> cells;
    const auto refuse = [&] {
        throw BadInput(fmt::format("{}:{} is no line of a manifest; choose another folder, or remove the file to begin anew",
                                   file.string(), cells.size() + 1));
    };
    for (std::string line; std::getline(lines, line);) {
        try {
            cells.push_back(parseCell(line));
        } catch (const Json::exception&) {
            refuse();
        } catch (const BadInput&) {
            refuse();
        }
    }
    return cells;
}

std::optional<std::string> difference(const std::vector<ManifestCell>& manifest, const std::vector<ManifestCell>& other) {
    for (std::size_t i = 0; i < std::min(manifest.size(), other.size()); ++i)
        if (manifest[i] != other[i]) return fmt::format("in cell {}, {}", i + 1, differingMember(manifest[i], other[i]));
    if (manifest.size() == other.size()) return {};
    return fmt::format("there are {} cells, not {}", manifest.size(), other.size());
}

void freezeManifest(const std::filesystem::path& folder, const std::vector<ManifestCell>& planned) {
    if (!std::filesystem::exists(manifestFile(folder))) return writeManifest(folder, planned);
    if (const auto differs = difference(readManifest(folder), planned))
        throw BadInput(
            fmt::format("{} is not what this command would measure: {}; give the options (and the program) that it "
                        "was made with, or another --out",
                        manifestFile(folder).string(), *differs));
}

CellRange shardRange(const std::string& text, std::size_t cells) {
    const std::size_t slash = text.find('/');
    const std::size_t index = number(std::string_view(text).substr(0, slash));
    const std::size_t count = slash == std::string::npos ? 0 : number(std::string_view(text).substr(slash + 1));
    if (index < 1 || index > count)
        throw BadInput(fmt::format("--shard is \"{}\"; it is written i/n with i from 1 to n, such as 2/8", text));
    return {(index - 1) * cells / count, index * cells / count};
}

CellRange cellRange(std::size_t number, std::size_t cells) {
    if (number < 1 || number > cells)
        throw BadInput(fmt::format("--cell is {}; the manifest's cells are 1 to {}", number, cells));
    return {number - 1, number};
}

} // namespace shadowbench::shards
