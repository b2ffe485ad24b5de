#include "groundtruth/store/cache.h"

#include "base/files.h"
#include "base/progress_line.h"
#include "cli/command.h"
#include "groundtruth/contract/reference_files.h"
#include "groundtruth/oracle.h"
#include "groundtruth/store/cache_limits.h"
#include "groundtruth/store/golden.h"
#include "harness/cells/golden_contents.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

namespace shadowbench {
namespace {

using groundtruth::Cache;
using groundtruth::CacheEntry;
using Json = nlohmann::ordered_json;
using FileClock = std::filesystem::file_time_type::clock;

struct CacheOptions {
    std::filesystem::path folder; // empty: the default
    bool json = false;
    bool quiet = false;
};

struct PruneOptions {
    std::string maxSize, olderThan;
    bool all = false;
    bool dryRun = false;
};

Cache cacheOf(const CacheOptions& options) {
    return Cache(options.folder.empty() ? groundtruth::defaultCacheFolder() : options.folder);
}

std::string utc(std::filesystem::file_time_type time) {
    const auto seconds = std::chrono::time_point_cast<std::chrono::seconds>(FileClock::to_sys(time));
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)));
}

std::string age(const CacheEntry& entry) {
    const auto unused = std::chrono::duration_cast<std::chrono::seconds>(FileClock::now() - entry.lastUse);
    return groundtruth::durationText(std::max(unused, std::chrono::seconds(0)));
}

/// Whether this program never reads it, as its own code would compute it otherwise, or may.
bool isOfOtherCode(const CacheEntry& entry) { return !groundtruth::allSources().contains(entry.sources); }

std::uintmax_t sum(const std::vector<CacheEntry>& entries) {
    std::uintmax_t bytes = 0;
    for (const CacheEntry& entry : entries) bytes += entry.bytes;
    return bytes;
}

/// What the entry's first line says; nothing if that cannot be read.
std::optional<groundtruth::EntryHeader> headerOf(const CacheEntry& entry) {
    std::string line;
    if (!std::getline(std::ifstream(entry.file, std::ios::binary), line)) return std::nullopt;
    try {
        return groundtruth::decodeHeader(line + "\n");
    } catch (const BadInput&) {
        return std::nullopt;
    }
}

Json brief(const CacheEntry& entry) {
    return {{"key", entry.key}, {"sources", entry.sources}, {"bytes", entry.bytes}, {"last_use", utc(entry.lastUse)}};
}

Json withFacts(const CacheEntry& entry) {
    Json json = brief(entry);
    const auto header = headerOf(entry);
    if (!header) return json;
    json["oracle"] = header->provenance.oracle;
    json["size"] = {header->width, header->height};
    json["samples"] = header->provenance.samples;
    json["seconds"] = header->provenance.seconds;
    return json;
}

std::string row(const CacheEntry& entry) {
    const auto header = headerOf(entry);
    const std::string facts = header ? fmt::format("{:<14}{:>11}{:>9}{:>14.1f}", header->provenance.oracle,
                                                   fmt::format("{} × {}", header->width, header->height),
                                                   header->provenance.samples, header->provenance.seconds)
                                     : fmt::format("{:<48}", "unreadable");
    return fmt::format("{}  {}{:>12}{:>10}\n", entry.key, facts, groundtruth::bytesText(entry.bytes), age(entry));
}

ExitCode list(const CacheOptions& options) {
    const Cache cache = cacheOf(options);
    const std::vector<CacheEntry> entries = cache.entries();
    if (options.json) {
        Json json{{"folder", cache.folder().string()}, {"bytes", sum(entries)}, {"max_bytes", cache.maxBytes()}};
        json["entries"] = Json::array();
        for (const CacheEntry& entry : entries) json["entries"].push_back(withFacts(entry));
        fmt::print("{}\n", json.dump(2));
        return ExitCode::Pass;
    }
    if (!entries.empty() && !options.quiet)
        fmt::print("{:<34}{:<14}{:>10}{:>9}{:>14}{:>12}{:>10}\n", "key", "oracle", "pixels", "samples", "computed in s",
                   "size", "unused");
    if (!options.quiet)
        for (const CacheEntry& entry : entries) fmt::print("{}", row(entry));
    const auto others = std::ranges::count_if(entries, isOfOtherCode);
    fmt::print("{}: {} references, {} of at most {}{}\n", cache.folder().string(), entries.size(),
               groundtruth::bytesText(sum(entries)), groundtruth::bytesText(cache.maxBytes()),
               others > 0 ? fmt::format("; {} that another program computed go with `cache prune`", others) : "");
    return ExitCode::Pass;
}

/// What is wrong with an intact entry that has the key of a golden reference; nothing if it has its pixels, too.
std::optional<std::string> unlikeGolden(const CacheEntry& entry) {
    if (!committedContents().contains(entry.key) || isOfOtherCode(entry)) return std::nullopt;
    try {
        const groundtruth::Reference kept = groundtruth::decode(readFile(entry.file), entry.key);
        requireGolden(committedContents(), entry.key, contentOf(contentHashes(kept)));
        return std::nullopt;
    } catch (const Error& error) {
        return error.what();
    }
}

ExitCode verify(const CacheOptions& options) {
    const Cache cache = cacheOf(options);
    const std::vector<CacheEntry> entries = cache.entries();
    ProgressLine line("verify", static_cast<int>(entries.size()), options.quiet);
    Json damaged = Json::array();
    int done = 0;
    for (const CacheEntry& entry : entries) {
        line.show(done++, 0, "checksums");
        std::optional<std::string> what = groundtruth::damage(entry);
        if (!what) what = unlikeGolden(entry);
        if (what) damaged.push_back({{"file", entry.file.string()}, {"damage", *what}});
    }
    line.show(done, 0, "");
    if (options.json) {
        fmt::print("{}\n", Json{{"folder", cache.folder().string()}, {"verified", done}, {"damaged", damaged}}.dump(2));
    } else {
        for (const Json& one : damaged)
            fmt::print("{}: {}\n", one["file"].get<std::string>(), one["damage"].get<std::string>());
        fmt::print("{}: {} references, {} damaged{}\n", cache.folder().string(), done, damaged.size(),
                   damaged.empty() ? "" : "; remove the files named: what is missing is computed again");
    }
    return damaged.empty() ? ExitCode::Pass : ExitCode::Internal;
}

groundtruth::PruneRules rulesOf(const PruneOptions& options) {
    groundtruth::PruneRules rules;
    rules.sources = groundtruth::allSources();
    if (options.all) rules.maxBytes = 0;
    if (!options.maxSize.empty()) rules.maxBytes = groundtruth::bytesOf(options.maxSize);
    if (!options.olderThan.empty()) rules.olderThan = groundtruth::durationOf(options.olderThan);
    return rules;
}

ExitCode prune(const CacheOptions& options, const PruneOptions& what) {
    const Cache cache = cacheOf(options);
    groundtruth::PruneRules rules = rulesOf(what);
    if (!rules.maxBytes && !rules.olderThan) rules.maxBytes = cache.maxBytes();
    const groundtruth::Pruned pruned = cache.prune(rules, what.dryRun);
    if (options.json) {
        Json json{{"folder", cache.folder().string()}, {"dry_run", what.dryRun}, {"bytes", sum(pruned.entries)}};
        json["removed"] = Json::array();
        for (const CacheEntry& entry : pruned.entries) json["removed"].push_back(brief(entry));
        json["leftovers"] = pruned.leftovers.size();
        fmt::print("{}\n", json.dump(2));
        return ExitCode::Pass;
    }
    if (!options.quiet)
        for (const CacheEntry& entry : pruned.entries)
            fmt::print("{}{:>12}  unused for {}\n", entry.key, groundtruth::bytesText(entry.bytes), age(entry));
    fmt::print("{}: {} {} references, {}, and {} leftovers of killed writers\n", cache.folder().string(),
               what.dryRun ? "would remove" : "removed", pruned.entries.size(), groundtruth::bytesText(sum(pruned.entries)),
               pruned.leftovers.size());
    return ExitCode::Pass;
}

void addCommon(CLI::App& verb, CacheOptions& options) {
    verb.add_option("--cache", options.folder, "Folder of references (default: $SHADOWBENCH_CACHE or ~/.cache/shadowbench)");
    verb.add_flag("--json", options.json, "For machines");
    verb.add_flag("--quiet", options.quiet, "Only the last line");
}

} // namespace

void addCache(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("cache", "Shows, checks and prunes the kept references");
    verb->require_subcommand(1);
    verb->footer("After every store the least recently used references above $SHADOWBENCH_CACHE_SIZE (default 4G) go.\n"
                 "Examples:\n  shadowbench cache list\n  shadowbench cache prune --max-size 500M --dry-run");
    const auto options = std::make_shared<CacheOptions>();

    CLI::App* listVerb = verb->add_subcommand("list", "Lists references, the most recently used first");
    listVerb->footer("Example:\n  shadowbench cache list --json");
    addCommon(*listVerb, *options);
    listVerb->callback([&action, options] { action = [options] { return list(*options); }; });

    CLI::App* verifyVerb = verb->add_subcommand(
        "verify", "Checks every reference's checksum, and its pixels where it is a golden one; exit code 1 if one is "
                  "wrong");
    verifyVerb->footer("Example:\n  shadowbench cache verify --quiet");
    addCommon(*verifyVerb, *options);
    verifyVerb->callback([&action, options] { action = [options] { return verify(*options); }; });

    const auto what = std::make_shared<PruneOptions>();
    CLI::App* pruneVerb = verb->add_subcommand(
        "prune", "Removes references that other code computed than this program's, and those above the size that is kept");
    pruneVerb->footer("Example:\n  shadowbench cache prune --older-than 30d --max-size 2G");
    addCommon(*pruneVerb, *options);
    CLI::Option* size = pruneVerb->add_option("--max-size", what->maxSize, "Keep at most this much: 500M, 4G");
    CLI::Option* old =
        pruneVerb->add_option("--older-than", what->olderThan, "Remove what was not used for so long: 12h, 30d");
    pruneVerb->add_flag("--all", what->all, "Remove all")->excludes(size)->excludes(old);
    pruneVerb->add_flag("--dry-run", what->dryRun, "Only say what would go");
    pruneVerb->callback([&action, options, what] { action = [options, what] { return prune(*options, *what); }; });
}

} // namespace shadowbench
