#include "groundtruth/store/cache.h"

#include "base/error.h"
#include "base/files.h"
#include "base/folder_lock.h"
#include "groundtruth/contract/reference_files.h"
#include "groundtruth/store/cache_limits.h"

#include <cstdlib>
#include <fmt/format.h>
#include <pwd.h>
#include <system_error>
#include <unistd.h>

namespace shadowbench::groundtruth {
namespace {

std::filesystem::path variable(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

std::filesystem::path home() {
    if (std::filesystem::path folder = variable("HOME"); !folder.empty()) return folder;
    const passwd* user = getpwuid(getuid());
    if (user == nullptr || user->pw_dir == nullptr)
        throw BadInput("there is no home folder to keep references in: set SHADOWBENCH_CACHE to a folder");
    return user->pw_dir;
}

/// Nothing, after a warning, if the file cannot be read (it may be intact, so it stays). One that another process has just
/// removed is no reason for a warning.
std::optional<std::string> contents(const std::filesystem::path& file) {
    try {
        return readFile(file);
    } catch (const BadInput& error) {
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored)) return std::nullopt;
        fmt::print(stderr, "warning: a stored reference is not used: {}\n", error.what());
        return std::nullopt;
    }
}

/// The file's time of modification is that of the last use. In a cache of another user it cannot be set, and need not: the
/// owner prunes it.
void touch(const std::filesystem::path& file) {
    std::error_code ignored;
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now(), ignored);
}

bool isHex(std::string_view text, std::size_t digits) {
    return text.size() == digits && text.find_first_not_of("0123456789abcdef") == text.npos;
}

} // namespace

std::filesystem::path defaultCacheFolder() {
    if (std::filesystem::path own = variable("SHADOWBENCH_CACHE"); !own.empty()) return own;
    // The XDG specification has relative paths ignored.
    if (const std::filesystem::path xdg = variable("XDG_CACHE_HOME"); xdg.is_absolute()) return xdg / "shadowbench";
    return home() / ".cache" / "shadowbench";
}

bool isKey(std::string_view text) { return isHex(text, 32); }
bool isSources(std::string_view text) { return isHex(text, 12); }

std::uintmax_t defaultCacheSize() {
    constexpr std::uintmax_t size = std::uintmax_t{4} << 30;
    const char* value = std::getenv("SHADOWBENCH_CACHE_SIZE");
    if (value == nullptr || *value == '\0') return size;
    try {
        return bytesOf(value);
    } catch (const BadInput& error) {
        throw BadInput(fmt::format("SHADOWBENCH_CACHE_SIZE: {}", error.what()));
    }
}

std::filesystem::path Cache::entry(const std::string& key, const std::string& sources) const {
    if (!isKey(key)) throw InternalError(fmt::format("\"{}\" is not the key of a reference", key));
    if (!isSources(sources)) throw InternalError(fmt::format("\"{}\" is not the hash of an oracle's sources", sources));
    return folder_ / key.substr(0, 2) / fmt::format("{}.{}.ref", key, sources);
}

std::optional<Reference> Cache::find(const std::string& key, const std::string& sources) const {
    const std::filesystem::path file = entry(key, sources);
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    const std::optional<std::string> bytes = contents(file);
    if (!bytes) return std::nullopt;
    try {
        Reference reference = decode(*bytes, key);
        touch(file);
        return reference;
    } catch (const BadInput& damage) {
        std::filesystem::remove(file, error);
        const std::string_view outcome = error ? "it cannot be removed" : "it was removed and will be computed again";
        fmt::print(stderr, "warning: {}: {}; {}\n", file.string(), damage.what(), outcome);
        return std::nullopt;
    }
}

void Cache::store(const Reference& reference) const {
    writeFile(entry(reference.provenance.key, reference.provenance.sources), encode(reference));
    prune({.maxBytes = maxBytes_, .olderThan = {}});
}

Reference Cache::get(const std::string& key, const std::string& sources, const std::function<Reference()>& compute,
                     const Progress& progress) const {
    if (std::optional<Reference> known = find(key, sources)) return std::move(*known);
    // Keys that share a folder share the lock. Where there is none to be had (a cache that cannot be written), each process
    // computes for itself.
    const FolderLock lock(entry(key, sources).parent_path(), [&] {
        if (progress) progress(0, "waiting for another process to compute this or a neighbouring reference");
    });
    if (std::optional<Reference> known = find(key, sources)) return std::move(*known); // by whom the lock waited for
    Reference reference = compute();
    try {
        store(reference);
    } catch (const InternalError& error) {
        fmt::print(stderr, "warning: keeping a reference for the next run: {}\n", error.what());
    }
    return reference;
}

} // namespace shadowbench::groundtruth
