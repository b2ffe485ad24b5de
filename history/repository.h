// Commits as git knows them, where there is a repository.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::history {

class Repository {
public:
    /// The repository that `folder` lies in, or would if it were made; nothing without one, or without git.
    static std::optional<Repository> around(const std::filesystem::path& folder);

    /// The whole hash of a commit that `revision` names, as `git describe` does, too; nothing if the repository lacks it.
    [[nodiscard]] std::optional<std::string> commit(const std::string& revision) const;

    /// When a commit was made, UTC, as sorts: "20261121T232136Z". Nothing if the repository does not have the commit.
    [[nodiscard]] std::optional<std::string> date(const std::string& commit) const;

    /// Its first line; "" if the repository does not have it.
    [[nodiscard]] std::string subject(const std::string& commit) const;

    /// `commits` with ancestors before descendants, else by date; nothing if the repository lacks one of them.
    [[nodiscard]] std::optional<std::vector<std::string>> inOrder(const std::vector<std::string>& commits) const;

    /// The commits that `head` has and `base` has not, `head` included, oldest first.
    [[nodiscard]] std::vector<std::string> between(const std::string& base, const std::string& head) const;

    /// The commit that halves those between: the next that `git bisect` would try.
    [[nodiscard]] std::string middle(const std::string& base, const std::string& head) const;

private:
    explicit Repository(std::filesystem::path folder) : folder_(std::move(folder)) {}

    std::filesystem::path folder_;
};

} // namespace shadowbench::history
