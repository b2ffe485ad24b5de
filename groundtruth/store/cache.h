// Content-addressed store of references: one checksummed file per key and hash of the code that computed it, so that nothing
// outlives its code; written whole or not at all; bounded in size, the least recently used entries go first. Safe for
// several processes: an entry appears whole and disappears whole.
#pragma once

#include "base/progress.h"
#include "groundtruth/contract/reference.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowbench::groundtruth {

/// Where references are kept: $SHADOWBENCH_CACHE, else $XDG_CACHE_HOME/shadowbench, else ~/.cache/shadowbench.
std::filesystem::path defaultCacheFolder();

/// The most bytes that a cache keeps: $SHADOWBENCH_CACHE_SIZE (such as 500M), else 4 GiB. Throws BadInput for a variable
/// that is no size.
std::uintmax_t defaultCacheSize();

/// Whether `text` has the shape of a key, 32 hex digits, or of a hash of sources, 12.
bool isKey(std::string_view text);
bool isSources(std::string_view text);

/// An entry as its folder shows it. Entries are not compressed: 29 bytes a pixel.
struct CacheEntry {
    std::string key;
    std::filesystem::path file;
    std::uintmax_t bytes = 0;
    std::filesystem::file_time_type lastUse; // when it was stored or last found: the file's time of modification
    std::string sources = {};                // Provenance::sources; "" of a program that named none
};

/// What prune removes: entries that break a rule, and files that a killed writer left an hour ago or earlier.
struct PruneRules {
    std::optional<std::uintmax_t> maxBytes;            // the least recently used go until the others fit
    std::optional<std::chrono::seconds> olderThan;     // those not used for longer go
    std::optional<std::set<std::string>> sources = {}; // those that other code computed go
};

struct Pruned {
    std::vector<CacheEntry> entries;
    std::vector<std::filesystem::path> leftovers; // of killed writers
};

class Cache {
public:
    /// `maxBytes` is kept to after every store.
    explicit Cache(std::filesystem::path folder, std::uintmax_t maxBytes = defaultCacheSize())
        : folder_(std::move(folder)), maxBytes_(maxBytes) {}

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] std::uintmax_t maxBytes() const { return maxBytes_; }

    /// The stored reference, which counts as used now; nothing when absent or damaged (a damaged entry is removed and
    /// reported on stderr in one line).
    [[nodiscard]] std::optional<Reference> find(const std::string& key, const std::string& sources) const;

    /// Stores, then removes the least recently used entries above the size; a failure to write or remove (full disk, no
    /// permission) throws InternalError and leaves no partial entry. Writers of the same key do not disturb each other: the
    /// last one's whole file stays.
    void store(const Reference& reference) const;

    /// `find`, else `compute` and `store`, in one process at a time; `progress` reports a wait for another one. A cache that
    /// cannot be written costs a warning, not the run.
    Reference get(const std::string& key, const std::string& sources, const std::function<Reference()>& compute,
                  const Progress& progress = {}) const;

    /// Where the entry of `key` that code of the hash `sources` computed is or would be. Throws InternalError unless
    /// isKey(key) and isSources(sources).
    [[nodiscard]] std::filesystem::path entry(const std::string& key, const std::string& sources) const;

    /// All entries, the most recently used first; a missing folder holds none. Throws InternalError when the folder cannot
    /// be read.
    [[nodiscard]] std::vector<CacheEntry> entries() const;

    /// Removes what `rules` name and returns it; with `dryRun` only returns it. An entry that is being written is never
    /// touched, one that was used meanwhile stays, nothing but entries and leftovers is. Throws InternalError when a file
    /// cannot be removed.
    Pruned prune(const PruneRules& rules, bool dryRun = false) const;

private:
    std::filesystem::path folder_;
    std::uintmax_t maxBytes_;
};

/// What is wrong with the entry's bytes (checksum, header, images), in a sentence; nothing if they are intact. Does not
/// count as a use.
std::optional<std::string> damage(const CacheEntry& entry);

} // namespace shadowbench::groundtruth
