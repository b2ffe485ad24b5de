#include "harness/cells/golden.h"

#include "base/error.h"
#include "base/progress_line.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <set>
#include <system_error>

namespace shadowbench {
namespace {

using groundtruth::Reference;

/// One reference that a run asks for.
struct Wanted {
    const Scene* scene;
    GoldenName name;
    bool hasImages = false; // else the hashes are all that is kept
};

class Selection {
public:
    explicit Selection(const GoldenOptions& options) : options_(options) {
        std::vector<std::string> ids = options.scenes.empty() ? standardScenes() : options.scenes;
        if (options.scenes.empty()) ids.insert(ids.end(), options.judged.begin(), options.judged.end());
        for (const std::string& id : ids) scenes_.push_back(loadScene(id, options.profile, metrics::boundedMetrics()));
        for (const Scene& scene : scenes_) add(scene);
        std::ranges::sort(wanted_, {}, &Wanted::name);
        if (wanted_.empty())
            throw BadInput("none of the scenes has such a reference: choose another --scene, --truth or --frame");
    }

    [[nodiscard]] const std::vector<Wanted>& wanted() const { return wanted_; }

    /// Entries of `lock` within the options that no run asks for.
    [[nodiscard]] std::vector<GoldenEntry> gone(const GoldenLock& lock) const {
        std::vector<GoldenEntry> result;
        for (const GoldenEntry& entry : lock.entries) {
            const bool asked = std::ranges::find(wanted_, entry.name, &Wanted::name) != wanted_.end();
            if (!asked && holds(entry.name)) result.push_back(entry);
        }
        return result;
    }

private:
    void add(const Scene& scene) {
        for (const auto& [truth, frame] : askedTruths(scene)) {
            const GoldenName name{scene.id, truth, frame};
            const bool hasImages = !isJudgedBeside(scene) && truth != Truth::Area && frame == scene.timeline.still - 1;
            if (holds(name)) wanted_.push_back({&scene, name, hasImages});
        }
    }

    /// Every clone pays for images, and hashes suffice where nobody looks at them.
    [[nodiscard]] bool isJudgedBeside(const Scene& scene) const {
        return std::ranges::find(options_.judged, scene.id) != options_.judged.end();
    }

    [[nodiscard]] bool holds(const GoldenName& name) const {
        const bool scene = options_.scenes.empty() ||
                           std::ranges::any_of(scenes_, [&](const Scene& chosen) { return chosen.id == name.scene; });
        return scene && options_.truth.value_or(name.truth) == name.truth &&
               options_.frame.value_or(name.frame) == name.frame;
    }

    const GoldenOptions& options_;
    std::vector<Scene> scenes_;
    std::vector<Wanted> wanted_;
};

void requireProfile(const GoldenLock& lock, const GoldenOptions& options) {
    if (lock.profile != options.profile)
        throw BadInput(fmt::format("{} holds the references of the {} profile, not of {}: choose that one or another folder",
                                   lockFile(options.folder).string(), name(lock.profile), name(options.profile)));
}

GoldenEntry entryOf(const Wanted& wanted, const Reference& reference) {
    GoldenEntry entry;
    entry.name = wanted.name;
    entry.size = {reference.visibility.width(), reference.visibility.height()};
    entry.provenance = reference.provenance;
    entry.provenance.seconds = 0;
    entry.hashes = contentHashes(reference);
    if (wanted.hasImages) entry.file = fmt::format("{}-{}.exr", entry.name.scene, name(entry.name.truth));
    return entry;
}

std::string changedImages(const groundtruth::ContentHashes& before, const groundtruth::ContentHashes& after) {
    std::vector<std::string> names;
    const auto compare = [&](const std::string& a, const std::string& b, const char* name) {
        if (a != b) names.emplace_back(name);
    };
    compare(before.visibility, after.visibility, "visibility");
    compare(before.sigma, after.sigma, "σ");
    compare(before.surface, after.surface, "surface");
    compare(before.id, after.id, "surface ids");
    compare(before.edgeDistance, after.edgeDistance, "edge distance");
    return fmt::format("{} (only the hashes of this frame are kept)", fmt::join(names, ", "));
}

/// The committed images of `entry`; nothing if it has none. Throws BadInput if they are not what the lock says.
std::optional<Reference> committed(const GoldenEntry& entry, const std::filesystem::path& folder) {
    if (entry.file.empty()) return std::nullopt;
    Reference reference = groundtruth::readGolden(folder / entry.file);
    if (contentHashes(reference) != entry.hashes)
        throw BadInput(fmt::format("{} does not hold the images that the lock names: restore it or accept the new ones",
                                   (folder / entry.file).string()));
    return reference;
}

GoldenResult compare(const GoldenEntry* before, const GoldenEntry& after, const Reference& reference,
                     const std::filesystem::path& folder) {
    if (before == nullptr) return {after.name, GoldenStatus::New, "not in the lock", ""};
    GoldenResult result{after.name, GoldenStatus::Identical, "", describeChange(before->provenance, after.provenance)};
    if (result.note.empty() && before->provenance.key != after.provenance.key)
        result.note = "another key: the scene, the request or the arithmetic behind them changed";
    const bool same = before->hashes == after.hashes;
    if (!same) result.status = GoldenStatus::Changed;
    try {
        const std::optional<Reference> images = committed(*before, folder);
        if (!same)
            result.what = images ? describe(difference(*images, reference)) : changedImages(before->hashes, after.hashes);
    } catch (const BadInput& error) {
        result.status = GoldenStatus::Changed;
        result.what = error.what();
    }
    return result;
}

/// Calls `use` with every wanted reference, computed anew.
void forEachComputed(const Selection& selection, bool quiet,
                     const std::function<void(const Wanted&, const Progress&)>& use) {
    const std::vector<Wanted>& wanted = selection.wanted();
    ProgressLine line("golden references", static_cast<int>(wanted.size()), quiet);
    int done = 0;
    for (const Wanted& one : wanted) {
        const std::string what = fmt::format("{} {} frame {}", one.name.scene, name(one.name.truth), one.name.frame);
        line.show(done, 0, what);
        use(one, [&](double share, std::string_view) { line.show(done, share, what); });
        ++done;
    }
    line.show(done, 0, "");
}

Reference computed(const Wanted& wanted, const Progress& progress) {
    return groundtruth::compute(referenceRequest(*wanted.scene, wanted.name.truth, wanted.name.frame), progress);
}

void sortByName(std::vector<GoldenResult>& results) { std::ranges::stable_sort(results, {}, &GoldenResult::name); }

void removeFile(const std::filesystem::path& file) {
    std::error_code failure;
    std::filesystem::remove(file, failure);
    if (failure)
        throw InternalError(fmt::format("removing {} failed: {}; remove it by hand", file.string(), failure.message()));
}

} // namespace

std::string_view name(GoldenStatus status) {
    switch (status) {
    case GoldenStatus::Identical:
        return "identical";
    case GoldenStatus::Changed:
        return "changed";
    case GoldenStatus::New:
        return "new";
    case GoldenStatus::Gone:
        return "gone";
    case GoldenStatus::Unverified:
        return "unverified";
    }
    return "";
}

std::vector<GoldenResult> verifyGolden(const GoldenOptions& options) {
    if (!std::filesystem::exists(lockFile(options.folder)))
        throw BadInput(fmt::format("there is no {}: name the folder with --golden, or make it with `shadowbench reference "
                                   "--accept`",
                                   lockFile(options.folder).string()));
    const GoldenLock lock = readLock(options.folder);
    requireProfile(lock, options);
    const Selection selection(options);
    std::vector<GoldenResult> results;
    forEachComputed(selection, options.quiet, [&](const Wanted& wanted, const Progress& progress) {
        try {
            const Reference reference = computed(wanted, progress);
            results.push_back(compare(lock.find(wanted.name), entryOf(wanted, reference), reference, options.folder));
        } catch (const Inconclusive& error) { // the others can still be verified
            results.push_back({wanted.name, GoldenStatus::Unverified, error.what(), ""});
        }
    });
    for (const GoldenEntry& entry : selection.gone(lock))
        results.push_back({entry.name, GoldenStatus::Gone, "in the lock, but no run asks for it", ""});
    sortByName(results);
    return results;
}

std::vector<GoldenResult> acceptGolden(const GoldenOptions& options) {
    GoldenLock lock;
    lock.profile = options.profile;
    if (std::filesystem::exists(lockFile(options.folder))) lock = readLock(options.folder);
    requireProfile(lock, options);
    const Selection selection(options);

    std::vector<GoldenResult> results;
    std::vector<GoldenEntry> accepted;
    std::vector<std::pair<std::string, Reference>> images; // by file
    forEachComputed(selection, options.quiet, [&](const Wanted& wanted, const Progress& progress) {
        Reference reference = computed(wanted, progress);
        accepted.push_back(entryOf(wanted, reference));
        results.push_back(compare(lock.find(wanted.name), accepted.back(), reference, options.folder));
        if (wanted.hasImages && results.back().status != GoldenStatus::Identical)
            images.emplace_back(accepted.back().file, std::move(reference));
    });

    const std::vector<GoldenEntry> gone = selection.gone(lock);
    for (const GoldenEntry& entry : gone) results.push_back({entry.name, GoldenStatus::Gone, "no run asks for it", ""});
    std::erase_if(lock.entries, [&](const GoldenEntry& old) {
        const auto same = [&](const GoldenEntry& entry) { return entry.name == old.name; };
        return std::ranges::any_of(accepted, same) || std::ranges::any_of(gone, same);
    });
    lock.entries.insert(lock.entries.end(), accepted.begin(), accepted.end());
    std::set<std::string> kept;
    for (const GoldenEntry& entry : lock.entries) kept.insert(entry.file);

    for (const auto& [file, reference] : images) writeGolden(reference, options.folder / file);
    writeLock(lock, options.folder);
    for (const GoldenEntry& entry : gone)
        if (!entry.file.empty() && !kept.contains(entry.file)) removeFile(options.folder / entry.file);
    sortByName(results);
    return results;
}

} // namespace shadowbench
