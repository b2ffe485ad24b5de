#include "harness/cells/golden_lock.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view formatName = "shadowbench golden references";
constexpr int formatVersion = 1;

Json toJson(const GoldenEntry& entry) {
    const groundtruth::Provenance& provenance = entry.provenance;
    Json json{{"scene", entry.name.scene},
              {"truth", name(entry.name.truth)},
              {"frame", entry.name.frame},
              {"size", {entry.size.x, entry.size.y}},
              {"key", provenance.key},
              {"oracle", provenance.oracle},
              {"samples", provenance.samples},
              {"tools", provenance.tools},
              {"measured", provenance.measured},
              {"hashes",
               {{"visibility", entry.hashes.visibility},
                {"sigma", entry.hashes.sigma},
                {"surface", entry.hashes.surface},
                {"id", entry.hashes.id},
                {"edge_distance", entry.hashes.edgeDistance}}}};
    if (!entry.file.empty()) json["file"] = entry.file;
    return json;
}

GoldenEntry entryFrom(const Json& json) {
    GoldenEntry entry;
    json.at("scene").get_to(entry.name.scene);
    entry.name.truth = truthNamed(json.at("truth").get<std::string>());
    entry.name.frame = wholeNumber<int>(json.at("frame"));
    entry.size = {wholeNumber<int>(json.at("size").at(0)), wholeNumber<int>(json.at("size").at(1))};
    json.at("key").get_to(entry.provenance.key);
    json.at("oracle").get_to(entry.provenance.oracle);
    entry.provenance.samples = wholeNumber<int>(json.at("samples"));
    json.at("tools").get_to(entry.provenance.tools);
    json.at("measured").get_to(entry.provenance.measured);
    const Json& hashes = json.at("hashes");
    hashes.at("visibility").get_to(entry.hashes.visibility);
    hashes.at("sigma").get_to(entry.hashes.sigma);
    hashes.at("surface").get_to(entry.hashes.surface);
    hashes.at("id").get_to(entry.hashes.id);
    hashes.at("edge_distance").get_to(entry.hashes.edgeDistance);
    entry.file = json.value("file", "");
    if (std::filesystem::path(entry.file).filename() != entry.file || entry.file == "." || entry.file == "..")
        throw BadInput(fmt::format("\"{}\" is not the name of a file beside the lock", entry.file));
    return entry;
}

GoldenLock lockFrom(const Json& json) {
    if (json.at("format") != formatName || json.at("version") != formatVersion)
        throw BadInput("it has another format or version");
    GoldenLock lock;
    lock.profile = profileNamed(json.at("profile").get<std::string>());
    for (const Json& entry : json.at("references")) lock.entries.push_back(entryFrom(entry));
    std::ranges::sort(lock.entries, {}, &GoldenEntry::name);
    return lock;
}

} // namespace

const GoldenEntry* GoldenLock::find(const GoldenName& wanted) const {
    const auto found = std::ranges::find(entries, wanted, &GoldenEntry::name);
    return found == entries.end() ? nullptr : &*found;
}

std::filesystem::path lockFile(const std::filesystem::path& folder) { return folder / "lock.json"; }

GoldenLock readLock(const std::filesystem::path& folder) { return parseLock(readFile(lockFile(folder)), lockFile(folder)); }

GoldenLock parseLock(const std::string& text, const std::filesystem::path& file) {
    try {
        return lockFrom(Json::parse(boundedJson(text, "its text")));
    } catch (const Json::exception& error) {
        throw BadInput(fmt::format("{} is no lock file of golden references: {}", file.string(), error.what()));
    } catch (const BadInput& error) {
        throw BadInput(fmt::format("{} is no lock file of golden references: {}", file.string(), error.what()));
    }
}

void writeLock(const GoldenLock& lock, const std::filesystem::path& folder) {
    std::vector<GoldenEntry> entries = lock.entries;
    std::ranges::sort(entries, {}, &GoldenEntry::name);
    Json json{{"format", formatName}, {"version", formatVersion}, {"profile", name(lock.profile)}};
    json["references"] = Json::array();
    for (const GoldenEntry& entry : entries) json["references"].push_back(toJson(entry));
    writeFile(lockFile(folder), json.dump(2) + "\n");
}

} // namespace shadowbench
