#include "gate/ci.h"

#include "base/folder_lock.h"
#include "gate/bounds.h"
#include "gate/ci_side.h"
#include "gate/failure_logs.h"
#include "gate/failure_pictures.h"
#include "gate/verdict.h"
#include "gate/waivers.h"
#include "groundtruth/store/cache.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <set>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

Policy policyOf(const CiSide& side) { return {.standard = {}, .config = side.config.judged}; }

/// What the head has; new is a row or a scene that the base's files do not name.
std::vector<Expected> expectedOf(const CiSide& base, const CiSide& head) {
    std::set<std::string> scenes, variants;
    for (const Record& record : base.records) {
        scenes.insert(record.scene);
        variants.insert(record.variant);
    }
    std::vector<Expected> all;
    for (const Record& record : head.records)
        all.push_back({record.scene, record.variant, !scenes.contains(record.scene) || !variants.contains(record.variant)});
    return all;
}

void judgeRecords(const CiSide& base, const CiSide& head, GateResult& result) {
    Union both = unite(policyOf(base), policyOf(head));
    result.loosened = std::move(both.loosened);
    static_cast<Comparison&>(result) = compare(base.records, head.records, both.policy.rules, expectedOf(base, head));
    std::ranges::move(judgeBounds(head.records, both.policy.config.bounds, true), std::back_inserter(result.changes));
    std::ranges::move(waive(result.changes, both.policy.config.waivers, today()), std::back_inserter(result.notes));
    const auto why = whyMeaningless(base.records, head.records, true);
    if (why && result.presence.failed.empty()) result.notCompared.push_back(*why); // else the failures say it
}

GateOptions shownOf(const CiOptions& options, const CiSide& head, const JudgedCommit& base) {
    GateOptions shown;
    shown.base = base.hash;
    shown.scenes = head.config.scenes;
    shown.externalFiles = head.config.renderers;
    shown.profile = head.config.profile;
    shown.out = options.out;
    return shown;
}

/// What a base cannot be judged by is no fault of the head.
CiSide baseOf(const CiSides& sides, const JudgedCommit& commit) {
    try {
        return sides.of(commit);
    } catch (const BadInput& error) {
        CiSide side;
        side.failure = error.what();
        return side;
    }
}

void takeLogs(const CiSide& side, const char* who, const JudgedCommit& commit, GateResult& result, const fs::path& out) {
    const fs::path logs = out / "logs" / who;
    if (fs::is_directory(side.logs)) {
        fs::create_directories(logs.parent_path());
        fs::copy(side.logs, logs, fs::copy_options::recursive);
    }
    if (!side.failure.empty()) {
        const std::string what = fmt::format("the {}, {}: {}", who, commit.name, side.failure);
        result.notCompared.push_back(what);
        if (auto log = failureLog(what, logs / "build.txt")) result.logs.push_back(std::move(*log));
    }
    std::ranges::move(failureLogs(side.records, logs), std::back_inserter(result.logs));
}

} // namespace

CiResult judgeCommits(const CiOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const ForeignRepository repository(fs::current_path());
    const JudgedCommit head = repository.head(), base = repository.base(options.base, head);
    if (head.hash == base.hash)
        throw Inconclusive(fmt::format("base and head are one commit, {}, so nothing would be judged; name another base, as "
                                       "--base HEAD~1",
                                       head.name));
    const fs::path cache = fs::absolute(options.cache.empty() ? groundtruth::defaultCacheFolder() : options.cache);
    const CiSides sides(repository, options, cache);
    const FolderLock alone(sides.folder(), [&] { // they would share the place of the work tree
        if (!options.quiet) fmt::print(stderr, "ci: waiting for another one of this repository\n");
    });
    const CiSide now = sides.of(head), before = baseOf(sides, base);
    CiResult judged{.result = {}, .shown = shownOf(options, now, base), .root = repository.root()};
    GateResult& result = judged.result;
    result.base = base.name;
    result.head = head.name;
    if (now.failure.empty() && before.failure.empty()) judgeRecords(before, now, result);
    if (repository.hasChanges())
        result.notes.emplace_back("the working tree has changes that are in no commit: they are not judged, HEAD is");
    for (const fs::path& earlier : {options.out / "logs", pictureFolder(options.out)}) fs::remove_all(earlier);
    takeLogs(now, "head", head, result, options.out);
    takeLogs(before, "base", base, result, options.out);
    result.pictures = copyFailures(result.changes, {before.records, before.images}, {now.records, now.images}, options.out);
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return judged;
}

} // namespace shadowbench::gate
