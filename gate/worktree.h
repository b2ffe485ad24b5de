// Commits of a repository that is not ours, and their files.
#pragma once

#include "base/process.h"

#include <filesystem>
#include <string>

namespace shadowbench::gate {

/// A commit that is judged or judged against.
struct JudgedCommit {
    std::string hash, tree; // of all its files
    std::string name;       // as reports name it
};

class ForeignRepository {
public:
    /// The one that `folder` lies in. Throws BadInput without one.
    explicit ForeignRepository(const std::filesystem::path& folder);

    [[nodiscard]] const std::filesystem::path& root() const { return root_; }

    /// What the working tree has checked out.
    [[nodiscard]] JudgedCommit head() const;

    /// `wanted`, if it is given; else where the branch of `head` left the one that it is to be merged into, by what CI hosts
    /// say of that and else by its usual names. Throws Inconclusive where that is not known.
    [[nodiscard]] JudgedCommit base(const std::string& wanted, const JudgedCommit& head) const;

    /// Whether tracked files have changes that are in no commit.
    [[nodiscard]] bool hasChanges() const;

private:
    [[nodiscard]] std::string commitOf(const std::string& revision) const; // "" if there is none
    [[nodiscard]] JudgedCommit named(const std::string& hash, const std::string& name) const;
    [[nodiscard]] std::string whyMissing(const std::string& revision) const;

    std::filesystem::path root_;
};

/// The files of a commit at `place`, as one of the repository's work trees, from construction to destruction. What a killed
/// process has left there is removed first.
class Worktree {
public:
    /// Throws Inconclusive with what git says where it cannot be made.
    Worktree(const ForeignRepository& repository, const JudgedCommit& commit, std::filesystem::path place);
    ~Worktree();
    Worktree(const Worktree&) = delete;
    Worktree& operator=(const Worktree&) = delete;

    [[nodiscard]] const std::filesystem::path& root() const { return place_; }

    /// Removes what is left of one that was there, also from the repository's list.
    static void remove(const ForeignRepository& repository, const std::filesystem::path& place) noexcept;

private:
    const ForeignRepository& repository_;
    std::filesystem::path place_;
};

/// A command in `folder` that may do what its user may: its environment but for what git's hooks set, and its limits.
Command unboundedCommand(const std::filesystem::path& program, std::vector<std::string> arguments,
                         const std::filesystem::path& folder);

} // namespace shadowbench::gate
