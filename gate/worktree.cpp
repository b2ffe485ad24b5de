#include "gate/worktree.h"

#include "base/error.h"
#include "base/git.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::minutes longestCheckout{30};

/// The last line that git prints: its warnings come first. "" if it fails.
std::string answer(const fs::path& folder, const std::vector<std::string>& arguments) {
    const auto lines = git(folder, arguments);
    return lines && !lines->empty() ? lines->back() : "";
}

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

/// git as its user runs it: filters such as those for large files are in the user's own configuration.
std::pair<bool, std::string> asUser(const fs::path& folder, std::vector<std::string> arguments) {
    const auto program = findProgram("git");
    if (!program) return {false, "there is no git; install it with: apt-get install git"};
    arguments.insert(arguments.begin(), {"-c", "safe.directory=*"}); // a container's user need not own the clone
    Command command = unboundedCommand(*program, std::move(arguments), folder);
    command.limit = longestCheckout;
    std::string said;
    const Finished end = runProcess(command, [&](std::string_view line) { said = line; });
    return {end.exitCode == 0 && end.signal == 0, said};
}

} // namespace

Command unboundedCommand(const fs::path& program, std::vector<std::string> arguments, const fs::path& folder) {
    Command command{program, std::move(arguments), folder};
    command.cpuLimit.reset();
    command.memoryLimit.reset();
    command.openFiles.reset();
    command.fileLimit = std::numeric_limits<std::uintmax_t>::max();
    command.environment = ownEnvironment();
    std::erase_if(*command.environment, [](const std::string& v) {
        return v.starts_with("GIT_DIR=") || v.starts_with("GIT_WORK_TREE=") || v.starts_with("GIT_INDEX_FILE=");
    });
    return command;
}

ForeignRepository::ForeignRepository(const fs::path& folder) : root_(answer(folder, {"rev-parse", "--show-toplevel"})) {
    if (root_.empty())
        throw BadInput(fmt::format("{} is in no git repository; run it inside that of the renderer, with git installed",
                                   fs::absolute(folder).lexically_normal().string()));
}

std::string ForeignRepository::commitOf(const std::string& revision) const {
    return answer(root_, {"rev-parse", "--verify", "--quiet", "--end-of-options", revision + "^{commit}"});
}

JudgedCommit ForeignRepository::named(const std::string& hash, const std::string& name) const {
    return {hash, answer(root_, {"rev-parse", hash + "^{tree}"}), name};
}

JudgedCommit ForeignRepository::head() const {
    const std::string hash = commitOf("HEAD");
    if (hash.empty()) throw BadInput(fmt::format("the repository {} has no commit yet; commit something", root_.string()));
    return named(hash, hash.substr(0, 12));
}

std::string ForeignRepository::whyMissing(const std::string& revision) const {
    const bool shallow = answer(root_, {"rev-parse", "--is-shallow-repository"}) == "true";
    return fmt::format("the base {} is no commit of {}; {}", revision, root_.string(),
                       shallow ? "this clone is shallow: fetch the whole history (git fetch --unshallow, fetch-depth: 0)"
                               : "fetch it, or name another one with --base");
}

JudgedCommit ForeignRepository::base(const std::string& wanted, const JudgedCommit& head) const {
    const auto nameOf = [](const std::string& word, const std::string& hash) {
        return hash.starts_with(word) ? hash.substr(0, 12) : fmt::format("{} ({})", word, hash.substr(0, 12));
    };
    const std::string target = variable("GITHUB_BASE_REF"), forked = variable("CI_MERGE_REQUEST_DIFF_BASE_SHA");
    if (const std::string given = wanted.empty() && target.empty() ? forked : wanted; !given.empty()) {
        const std::string hash = commitOf(given);
        if (hash.empty()) throw Inconclusive(whyMissing(given));
        return named(hash, nameOf(given, hash));
    }
    std::vector<std::string> targets{"origin/HEAD", "origin/main", "main"};
    if (!target.empty()) targets = {"origin/" + target};
    const auto known = std::ranges::find_if(targets, [&](const std::string& branch) { return !commitOf(branch).empty(); });
    if (known == targets.end())
        throw Inconclusive(target.empty() ? "there is no origin/HEAD, origin/main or main to judge against; name the base "
                                            "with --base"
                                          : whyMissing(targets.front()));
    const std::string hash = answer(root_, {"merge-base", head.hash, *known});
    if (hash.empty()) throw Inconclusive(whyMissing("of HEAD and " + *known));
    return named(hash, nameOf(*known, hash));
}

bool ForeignRepository::hasChanges() const {
    const auto lines = git(root_, {"status", "--porcelain", "--untracked-files=no"});
    return lines && !lines->empty();
}

Worktree::Worktree(const ForeignRepository& repository, const JudgedCommit& commit, fs::path place)
    : repository_(repository), place_(std::move(place)) {
    remove(repository_, place_);
    fs::create_directories(place_.parent_path());
    const auto [made, said] =
        asUser(repository_.root(), {"worktree", "add", "--detach", "--force", place_.string(), commit.hash});
    if (made) return;
    remove(repository_, place_);
    throw Inconclusive(fmt::format("checking out {} into {} failed: {}", commit.name, place_.string(), said));
}

Worktree::~Worktree() { remove(repository_, place_); }

void Worktree::remove(const ForeignRepository& repository, const fs::path& place) noexcept {
    try { // twice forced: one that was being made is locked
        git(repository.root(), {"worktree", "remove", "--force", "--force", place.string()});
    } catch (const std::exception&) { // the next one tries again
    }
    std::error_code ignored;
    fs::remove_all(place, ignored);
}

} // namespace shadowbench::gate
