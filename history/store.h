// The records of past commits: a folder with a file for each run's records of a commit.
//
// <committer's date>-<12 digits of the commit>-<8 digits of the content's hash>.jsonl, as in
// 20261121T232136Z-12d2dab1b42a-5f0c9a1e.jsonl: names sort by date, the same records have the same name, and different ones
// never do, so branches that both add to the history merge without a conflict. A commit may have several files: runs on
// several machines, of several sets of cells, or of the same again, which is what figures with noise need.
#pragma once

#include "harness/records/record.h"
#include "history/repository.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::history {

struct Added {
    std::filesystem::path file;
    bool isNew; // false: the history had the same records
};

/// Takes the records of a run into the history as they are, byte by byte. Throws BadInput when they cannot be read, are none
/// or of several commits, of one that `repository` does not have, or, unless `dirty`, of a program with changes that are not
/// committed.
Added add(const std::filesystem::path& records, const std::filesystem::path& history,
          const std::optional<Repository>& repository, bool dirty);

struct Commit {
    std::string hash;
    std::string date;            // of the committer, UTC, as sorts
    std::vector<Record> records; // in the order in which they were measured
};

struct Stored {
    std::vector<Commit> commits;         // by date
    std::vector<std::string> unreadable; // a sentence for each file that holds no records of the present schema
};

/// Everything in the folder; a record that several files hold counts once. Throws BadInput when there is no such folder.
Stored readHistory(const std::filesystem::path& history);

/// Puts ancestors before descendants where the repository has all commits; else they stay by date.
void sortByAncestry(std::vector<Commit>& commits, const std::optional<Repository>& repository);

} // namespace shadowbench::history
