#include "history/store.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <set>
#include <string_view>

namespace shadowbench::history {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view withChanges = "-dirty"; // as git describes it
constexpr std::size_t shortHashLength = 12;        // in the names of files

bool isOfOwnRevision(const Record& record) { return revisionOf(record) != record.commit; }

/// Whether what the figures are of had changes that are not committed.
bool isDirty(const Record& record) {
    return isOfOwnRevision(record) ? revisionOf(record).ends_with(withChanges) : record.dirty;
}

/// The commit that all records are of: of another renderer's rows its own, in whatever words they name it.
std::string commitOf(const std::vector<Record>& records, const fs::path& file, bool dirty) {
    const auto refuse = [&](const std::string& why) -> void {
        throw BadInput(fmt::format("adding {} to the history: {}", file.string(), why));
    };
    if (records.empty()) refuse("it holds no records; run `shadowbench run` first");
    std::string commit = revisionOf(records.front());
    for (const Record& record : records) {
        if (revisionOf(record) != commit)
            refuse(fmt::format("it mixes commits {} and {}; run one commit into a folder of its own", commit,
                               revisionOf(record)));
        if (isDirty(record) && !dirty)
            refuse("it was measured with changes that are not committed; commit them and run again, or say --dirty");
    }
    if (isOfOwnRevision(records.front()) && commit.ends_with(withChanges)) commit.resize(commit.size() - withChanges.size());
    return commit;
}

std::string fileName(const std::string& date, const std::string& commit, const std::string& content) {
    const auto digest = static_cast<std::uint32_t>(hash64(content) >> 32U);
    return fmt::format("{}-{}-{:08x}.jsonl", date, commit.substr(0, shortHashLength), digest);
}

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::error_code failure;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure))
        if (entry.path().extension() == ".jsonl" && !entry.path().filename().string().starts_with('.'))
            files.push_back(entry.path());
    if (failure) throw BadInput(fmt::format("cannot read the history {}: {}", folder.string(), failure.message()));
    std::ranges::sort(files);
    return files;
}

std::string dateIn(const fs::path& file) {
    const std::string name = file.filename().string();
    return name.substr(0, name.find('-'));
}

/// The commit that a record of a file is of: the name of the file has found out what a revision in words is.
std::string commitOf(const Record& record, const fs::path& file) {
    if (!isOfOwnRevision(record)) return record.commit;
    const std::string name = file.filename().string();
    return name.substr(name.find('-') + 1, shortHashLength);
}

} // namespace

Added add(const fs::path& records, const fs::path& history, const std::optional<Repository>& repository, bool dirty) {
    const std::vector<Record> added = readRecords(records);
    std::string commit = commitOf(added, records, dirty);
    if (!repository)
        throw BadInput(fmt::format("adding {} to the history: {} is in no git repository that can be read, so the date of "
                                   "commit {} is not known; name a folder of a clone with --to",
                                   records.string(), history.string(), commit));
    if (isOfOwnRevision(added.front())) commit = repository->commit(commit).value_or(commit);
    const auto date = repository->date(commit);
    if (!date)
        throw BadInput(
            fmt::format("adding {} to the history: the repository of {} has no commit {}; fetch it, or measure one "
                        "that it has",
                        records.string(), history.string(), commit));
    const std::string content = readFile(records);
    const fs::path file = history / fileName(*date, commit, content);
    if (fs::exists(file)) return {file, false};
    writeFile(file, content);
    return {file, true};
}

Stored readHistory(const fs::path& history) {
    Stored stored;
    std::map<std::string, Commit> commits;
    std::set<std::string> seen;
    for (const fs::path& file : filesIn(history)) {
        try {
            for (Record& record : readRecords(file)) {
                if (!seen.insert(toJson(record)).second) continue;
                const std::string hash = commitOf(record, file);
                Commit& commit = commits[hash];
                commit.hash = hash;
                commit.date = dateIn(file);
                commit.records.push_back(std::move(record));
            }
        } catch (const BadInput& error) {
            stored.unreadable.emplace_back(error.what());
        }
    }
    for (auto& [hash, commit] : commits) {
        std::ranges::stable_sort(commit.records, {}, &Record::time);
        stored.commits.push_back(std::move(commit));
    }
    std::ranges::stable_sort(stored.commits, {}, &Commit::date);
    return stored;
}

void sortByAncestry(std::vector<Commit>& commits, const std::optional<Repository>& repository) {
    if (!repository) return;
    std::vector<std::string> hashes;
    for (Commit& commit : commits) {
        if (commit.hash.size() == shortHashLength) commit.hash = repository->commit(commit.hash).value_or(commit.hash);
        hashes.push_back(commit.hash);
    }
    const auto ordered = repository->inOrder(hashes);
    if (!ordered) return;
    std::map<std::string, std::size_t> places;
    for (const std::string& hash : *ordered) places.emplace(hash, places.size());
    std::ranges::sort(commits, {}, [&](const Commit& commit) { return places.at(commit.hash); });
}

} // namespace shadowbench::history
