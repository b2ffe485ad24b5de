#include "history/repository.h"

#include "base/git.h"

#include <algorithm>
#include <ctime>
#include <fmt/chrono.h>
#include <map>
#include <string_view>

namespace shadowbench::history {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view hexadecimal = "0123456789abcdef";

bool isHash(const std::string& text) { return text.size() >= 7 && text.find_first_not_of(hexadecimal) == std::string::npos; }

/// What `git log` prints of a commit in `format`; "" if the repository lacks it. git's warnings come first, if any.
std::string askLog(const fs::path& folder, const std::string& commit, const std::string& format) {
    if (!isHash(commit)) return "";
    const auto lines = git(folder, {"log", "-1", "--no-show-signature", "--format=" + format, commit + "^{commit}", "--"});
    return lines && !lines->empty() ? lines->back() : "";
}

} // namespace

std::optional<Repository> Repository::around(const fs::path& folder) {
    fs::path present = fs::absolute(folder).lexically_normal();
    while (!fs::is_directory(present) && present != present.root_path()) present = present.parent_path();
    if (firstLine(git(present, {"rev-parse", "--is-inside-work-tree"})) != "true") return {};
    return Repository(present);
}

std::optional<std::string> Repository::commit(const std::string& revision) const {
    if (revision.starts_with('-')) return {};
    const std::string hash = firstLine(git(folder_, {"rev-parse", "--verify", "--quiet", revision + "^{commit}"}));
    return isHash(hash) ? std::optional(hash) : std::nullopt;
}

std::optional<std::string> Repository::date(const std::string& commit) const {
    const std::string seconds = askLog(folder_, commit, "%ct");
    if (seconds.empty()) return {};
    return fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(static_cast<std::time_t>(std::stoll(seconds))));
}

std::string Repository::subject(const std::string& commit) const { return askLog(folder_, commit, "%s"); }

std::optional<std::vector<std::string>> Repository::inOrder(const std::vector<std::string>& commits) const {
    if (!std::ranges::all_of(commits, isHash)) return {};
    std::vector<std::string> arguments{"rev-list", "--date-order", "--reverse"};
    arguments.insert(arguments.end(), commits.begin(), commits.end());
    const auto all = git(folder_, arguments);
    if (!all) return {};
    std::map<std::string_view, std::size_t> places;
    for (const std::string& commit : *all) places.emplace(commit, places.size());
    if (!std::ranges::all_of(commits, [&](const std::string& commit) { return places.contains(commit); })) return {};
    std::vector<std::string> ordered = commits;
    std::ranges::sort(ordered, {}, [&](const std::string& commit) { return places.at(commit); });
    return ordered;
}

std::vector<std::string> Repository::between(const std::string& base, const std::string& head) const {
    if (!isHash(base) || !isHash(head)) return {};
    const auto commits = git(folder_, {"rev-list", "--date-order", "--reverse", head, "^" + base});
    return commits.value_or(std::vector<std::string>{});
}

std::string Repository::middle(const std::string& base, const std::string& head) const {
    if (!isHash(base) || !isHash(head)) return "";
    return firstLine(git(folder_, {"rev-list", "--bisect", head, "^" + base}));
}

} // namespace shadowbench::history
