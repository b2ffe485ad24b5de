#include "harness/cells/golden_contents.h"

#include "base/error.h"
#include "embedded_golden_lock.h"
#include "harness/cells/golden_lock.h"

#include <fmt/format.h>

namespace shadowbench {

GoldenContents contentsOf(const GoldenLock& lock) {
    GoldenContents contents;
    for (const GoldenEntry& entry : lock.entries)
        contents[entry.provenance.key] = {entry.name.scene, std::string(name(entry.name.truth)), entry.name.frame,
                                          contentOf(entry.hashes)};
    return contents;
}

const GoldenContents& committedContents() {
    static const GoldenContents contents = [] {
        const embedded::File& file = embedded::golden_lock().front();
        return contentsOf(parseLock(std::string(file.text), file.path));
    }();
    return contents;
}

void requireGolden(const GoldenContents& golden, const std::string& key, const std::string& content) {
    const auto found = golden.find(key);
    if (found == golden.end() || found->second.content == content) return;
    const GoldenContent& wanted = found->second;
    throw Inconclusive(fmt::format(
        "the {} truth of {} frame {} is not the golden one, so nothing is scored against it: what computed it (POV-Ray, an "
        "oracle) has changed and its version has not. Look at `shadowbench reference --verify --scene {}`; if that finds "
        "it identical, only the kept one is wrong: empty the cache with `shadowbench cache prune --all`",
        wanted.truth, wanted.scene, wanted.frame, wanted.scene));
}

} // namespace shadowbench
