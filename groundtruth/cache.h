// Content-addressed store of references: one checksummed file per key, written whole or not at all.
#pragma once

#include "groundtruth/reference.h"

#include <filesystem>
#include <optional>
#include <utility>

namespace shadowbench::groundtruth {

/// Where references are kept: $SHADOWBENCH_CACHE, else $XDG_CACHE_HOME/shadowbench, else ~/.cache/shadowbench.
std::filesystem::path defaultCacheFolder();

class Cache {
public:
    explicit Cache(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// The stored reference; nothing when absent or damaged (a damaged entry is removed and reported on stderr in one line).
    [[nodiscard]] std::optional<Reference> find(const std::string& key) const;

    /// Stores; a failure to write (full disk, no permission) throws InternalError and leaves no partial entry. Writers of
    /// the same key do not disturb each other: the last one's whole file stays.
    void store(const Reference& reference) const;

    /// `find`, else `compute` and `store`; a cache that cannot be written costs a warning, not the run.
    Reference get(const Request& request, const Progress& progress = {}) const;

    /// Where the entry of `key` is or would be. Throws InternalError unless `key` is 32 hex digits.
    [[nodiscard]] std::filesystem::path entry(const std::string& key) const;

private:
    std::filesystem::path folder_;
};

} // namespace shadowbench::groundtruth
