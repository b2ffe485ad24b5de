// What a cache holds, and how it is kept small.
#include "groundtruth/store/cache.h"

#include "base/error.h"
#include "base/files.h"
#include "groundtruth/contract/reference_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <system_error>
#include <tuple>

namespace shadowbench::groundtruth {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view extension = ".ref";
constexpr std::size_t keyDigits = 32;
constexpr std::chrono::hours leftoverAge{1}; // an entry is written in well under a second

/// What lies in the cache's folders.
struct Listing {
    std::vector<CacheEntry> entries;
    std::vector<fs::path> leftovers;
};

/// "<key>.<sources>.ref", or the "<key>.ref" of older programs, in the folder of its first two digits.
bool isEntry(const fs::path& file) {
    const std::string name = file.stem().string(), key = name.substr(0, keyDigits);
    return file.extension() == extension && isKey(key) && file.parent_path().filename() == key.substr(0, 2) &&
           (name == key || (name[keyDigits] == '.' && isSources(name.substr(keyDigits + 1))));
}

CacheEntry entryOf(const fs::path& file, std::uintmax_t bytes, fs::file_time_type lastUse) {
    const std::string name = file.stem().string();
    return {name.substr(0, keyDigits), file, bytes, lastUse, name.size() > keyDigits ? name.substr(keyDigits + 1) : ""};
}

/// What an entry is written under.
bool isUnfinishedEntry(const fs::path& file) {
    return isTemporary(file) && file.extension() == extension && isKey(file.filename().string().substr(1, keyDigits));
}

std::optional<fs::file_time_type> modificationTime(const fs::path& file) {
    std::error_code gone;
    const fs::file_time_type time = fs::last_write_time(file, gone);
    return gone ? std::nullopt : std::optional(time);
}

void add(const fs::directory_entry& found, Listing& listing) {
    std::error_code gone; // files come and go while other processes write and prune
    if (!found.is_regular_file(gone) || found.is_symlink(gone)) return;
    const std::uintmax_t bytes = found.file_size(gone);
    const auto time = modificationTime(found.path());
    if (gone || !time) return;
    if (isEntry(found.path())) listing.entries.push_back(entryOf(found.path(), bytes, *time));
    if (isUnfinishedEntry(found.path()) && fs::file_time_type::clock::now() - *time >= leftoverAge)
        listing.leftovers.push_back(found.path());
}

Listing list(const fs::path& folder) {
    Listing listing;
    std::error_code failure;
    if (!fs::exists(folder, failure) && !failure) return listing;
    fs::directory_iterator groups(folder, failure);
    for (; !failure && groups != fs::directory_iterator(); groups.increment(failure)) {
        const std::string name = groups->path().filename().string();
        if (name.size() != 2) continue;
        std::error_code inner; // a folder that is no folder holds no entry
        for (fs::directory_iterator files(groups->path(), inner); !inner && files != fs::directory_iterator();
             files.increment(inner))
            add(*files, listing);
    }
    if (failure)
        throw InternalError(
            fmt::format("reading the cache {} failed: {}; choose another with --cache", folder.string(), failure.message()));
    // The name decides between equal times, so that every process names the same entries.
    std::ranges::sort(listing.entries, [](const CacheEntry& a, const CacheEntry& b) {
        return std::tie(b.lastUse, a.file) < std::tie(a.lastUse, b.file);
    });
    std::ranges::sort(listing.leftovers);
    return listing;
}

/// Removes the file; false if another process was faster.
bool removeFile(const fs::path& file) {
    std::error_code failure;
    const bool done = fs::remove(file, failure);
    if (failure)
        throw InternalError(fmt::format("removing {} failed: {}; remove it by hand or choose another cache", file.string(),
                                        failure.message()));
    return done;
}

/// `entries`, most recently used first, → those that break the rules, least recently used first.
std::vector<CacheEntry> entriesToRemove(const std::vector<CacheEntry>& entries, const PruneRules& rules) {
    const fs::file_time_type now = fs::file_time_type::clock::now();
    std::uintmax_t kept = 0;
    std::vector<CacheEntry> result;
    bool full = false;
    for (const CacheEntry& entry : entries) {
        const std::uintmax_t bytes = std::max<std::uintmax_t>(entry.bytes, 1); // an empty file counts, too
        const bool foreign = rules.sources && !rules.sources->contains(entry.sources);
        const bool old = rules.olderThan && now - entry.lastUse > *rules.olderThan;
        full = full || (rules.maxBytes && !foreign && !old && kept + bytes > *rules.maxBytes);
        if (full || old || foreign)
            result.push_back(entry);
        else
            kept += bytes;
    }
    std::ranges::reverse(result);
    return result;
}

} // namespace

std::vector<CacheEntry> Cache::entries() const { return list(folder_).entries; }

Pruned Cache::prune(const PruneRules& rules, bool dryRun) const {
    const Listing listing = list(folder_);
    Pruned pruned;
    for (const CacheEntry& entry : entriesToRemove(listing.entries, rules)) {
        const bool used = modificationTime(entry.file) != entry.lastUse;
        if (!used && (dryRun || removeFile(entry.file))) pruned.entries.push_back(entry);
    }
    for (const fs::path& file : listing.leftovers)
        if (dryRun || removeFile(file)) pruned.leftovers.push_back(file);
    return pruned;
}

std::optional<std::string> damage(const CacheEntry& entry) {
    try {
        decode(readFile(entry.file), entry.key);
        return std::nullopt;
    } catch (const BadInput& error) {
        return error.what();
    }
}

} // namespace shadowbench::groundtruth
