#include "gate/failure_pictures.h"

#include "gate/verdict.h"
#include "harness/cells/cell_images.h"

#include <algorithm>
#include <functional>

namespace shadowbench::gate {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostCells = 12; // more show the same fault again

using Failing = std::vector<std::pair<std::string, std::string>>; // scene, variant

Failing failingCells(const std::vector<Change>& changes, const std::function<bool(const Change&)>& isDrawable) {
    Failing cells;
    for (const Change& change : changes) {
        const bool drawn = change.direction == Direction::Worse && change.changeClass != Class::Instructions &&
                           change.changeClass != Class::Shader && change.changeClass != Class::Time &&
                           change.changeClass != Class::BreakPoint;
        if (!drawn || !isDrawable(change) || cells.size() == mostCells) continue;
        if (std::ranges::find(cells, std::pair(change.scene, change.variant)) == cells.end())
            cells.emplace_back(change.scene, change.variant);
    }
    return cells;
}

/// Returns the records of what was drawn.
std::vector<Record> draw(const MeasuredProgram& program, const Failing& cells, const JudgedCells& judged,
                         const fs::path& out, const Progress& progress) {
    std::vector<Record> records;
    for (const JudgedScene& scene : judged.scenes) {
        Step step{"pictures of " + scene.id,
                  {"run", "--scene", scene.argument, "--profile", std::string(name(judged.profile)), "--seed",
                   std::to_string(judged.seed), "--cost", "none", "--images"},
                  {},
                  "results.jsonl"};
        for (const auto& [id, variant] : cells)
            if (id == scene.id && program.knowsVariant(variant)) step.techniques.push_back(variant);
        if (step.techniques.empty()) continue;
        program.run(step, out, 1, progress);
        for (Record& record : readRecords(out / step.records)) records.push_back(std::move(record));
    }
    return records;
}

std::optional<Record> recordOf(const std::vector<Record>& records, const std::string& scene, const std::string& variant) {
    const auto found = std::ranges::find_if(
        records, [&](const Record& record) { return record.scene == scene && record.variant == variant; });
    return found == records.end() ? std::nullopt : std::optional(*found);
}

/// A cell's pictures, with what the scene's cells share.
void copyCell(const fs::path& images, const std::string& scene, const std::string& variant, const fs::path& to) {
    const fs::path from = images / scene;
    if (!fs::exists(from / fileName(variant) / "visibility.png")) return; // `run` without --images keeps less there
    fs::create_directories(to / scene);
    for (const fs::directory_entry& entry : fs::directory_iterator(from))
        if (entry.is_regular_file())
            fs::copy_file(entry.path(), to / scene / entry.path().filename(), fs::copy_options::overwrite_existing);
    fs::copy(from / fileName(variant), to / scene / fileName(variant));
}

fs::path folderOf(const fs::path& out, const std::string& scene, const std::string& variant) {
    const fs::path folder = out / "images" / scene / fileName(variant);
    return fs::exists(folder) ? folder : fs::path();
}

} // namespace

fs::path pictureFolder(const fs::path& out) { return out / "pictures"; }

std::vector<FailurePictures> drawFailures(const std::vector<Change>& changes, const JudgedCells& judged,
                                          const MeasuredProgram* base, const MeasuredProgram& head, const fs::path& out,
                                          const Progress& progress) {
    const Failing cells = failingCells(changes, [&](const Change& change) {
        return !change.variant.starts_with(externalPrefix) && judged.chooses(change.scene, change.variant);
    });
    if (cells.empty()) return {};
    const std::vector<Record> heads = draw(head, cells, judged, pictureFolder(out) / "head", progress);
    const std::vector<Record> bases =
        base == nullptr ? std::vector<Record>() : draw(*base, cells, judged, pictureFolder(out) / "base", progress);
    std::vector<FailurePictures> pictures;
    for (const auto& [scene, variant] : cells)
        pictures.push_back({scene, variant, folderOf(pictureFolder(out) / "head", scene, variant),
                            folderOf(pictureFolder(out) / "base", scene, variant), recordOf(heads, scene, variant),
                            recordOf(bases, scene, variant)});
    return pictures;
}

std::vector<FailurePictures> copyFailures(const std::vector<Change>& changes, const DrawnSide& base, const DrawnSide& head,
                                          const fs::path& out) {
    std::vector<FailurePictures> pictures;
    for (const auto& [scene, variant] : failingCells(worstFirst(changes), [](const Change&) { return true; })) {
        copyCell(head.images, scene, variant, pictureFolder(out) / "head" / "images");
        copyCell(base.images, scene, variant, pictureFolder(out) / "base" / "images");
        pictures.push_back({scene, variant, folderOf(pictureFolder(out) / "head", scene, variant),
                            folderOf(pictureFolder(out) / "base", scene, variant), recordOf(head.records, scene, variant),
                            recordOf(base.records, scene, variant)});
    }
    return pictures;
}

} // namespace shadowbench::gate
