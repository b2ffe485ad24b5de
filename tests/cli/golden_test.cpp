// Golden references: the committed ones, and the commands that verify and replace them.
#include "base/error.h"
#include "base/files.h"
#include "gate/gate.h"
#include "gate/gate_config.h"
#include "harness/cells/golden_lock.h"
#include "harness/metrics/table.h"
#include "scene/load/load.h"
#include "tests/support/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

const fs::path committed = fs::path(SOURCE_FOLDER) / "results/reference";

TEST(GoldenReferences, CommittedImagesAreWhatTheLockSays) {
    std::uintmax_t bytes = 0;
    for (const GoldenEntry& entry : readLock(committed).entries) {
        if (entry.file.empty()) continue;
        const groundtruth::Reference reference = groundtruth::readGolden(committed / entry.file);
        EXPECT_EQ(contentHashes(reference), entry.hashes) << entry.file;
        EXPECT_EQ(glm::ivec2(reference.visibility.width(), reference.visibility.height()), entry.size) << entry.file;
        bytes += fs::file_size(committed / entry.file);
    }
    EXPECT_GT(bytes, 0U);
    EXPECT_LT(bytes, 3U << 20); // every clone pays for them
}

/// The standard scenes and those that the gate judges beside them.
std::set<std::string> judgedScenes(Profile profile) {
    const std::vector<std::string> standard = standardScenes();
    std::set<std::string> scenes(standard.begin(), standard.end());
    const fs::path bounds = fs::path(SOURCE_FOLDER) / gate::GateOptions().bounds;
    for (const gate::GateRule& watch : gate::readGateConfig(bounds, profile).scenes) scenes.insert(watch.scene);
    return scenes;
}

TEST(GoldenReferences, AreAllThatTheGateAsksFor) {
    const GoldenLock lock = readLock(committed);
    std::size_t asked = 0;
    for (const std::string& id : judgedScenes(lock.profile)) {
        const Scene scene = loadScene(id, lock.profile, metrics::boundedMetrics());
        for (const auto& [truth, frame] : askedTruths(scene)) {
            ++asked;
            const GoldenEntry* entry = lock.find({id, truth, frame});
            ASSERT_NE(entry, nullptr) << id << " " << name(truth) << " frame " << frame;
            const bool standard = std::ranges::count(standardScenes(), id) > 0;
            EXPECT_EQ(!entry->file.empty(), standard && truth != Truth::Area && frame == scene.timeline.still - 1) << id;
        }
    }
    EXPECT_EQ(asked, lock.entries.size());
}

TEST(GoldenContents, ATruthWithALockedKeyAndOtherPixelsIsInconclusive) {
    const Folder folder;
    const Scene scene = loadScene(folder.write("tiny.toml", tinyScene()), Profile::Gate);
    const groundtruth::Cache cache(folder / "cache");
    for (const Truth truth : {Truth::Hard, Truth::PixelArea}) {
        GoldenContents golden;
        Truths unlocked(scene, cache, golden);
        const std::string key = unlocked.key(truth, 2), content = unlocked.content(truth, 2);
        golden[key] = {"tiny", std::string(name(truth)), 2, content};
        EXPECT_EQ(Truths(scene, cache, golden).content(truth, 2), content);

        golden[key].content[0] = content[0] == '0' ? '1' : '0';
        try {
            Truths(scene, cache, golden).at(truth, 2);
            ADD_FAILURE() << "a " << name(truth) << " truth that is not the golden one is given";
        } catch (const Inconclusive& error) {
            const std::string which = fmt::format("the {} truth of tiny frame 2", name(truth));
            for (const std::string& part :
                 {which, std::string("reference --verify --scene tiny"), std::string("cache prune --all")})
                EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }
}

TEST(GoldenContents, AreWhatARunAsksForByTheKeysOfThisProgram) {
    for (const char* id : {"dueling-frusta", "simple"}) {
        const Scene scene = loadScene(id, Profile::Gate, metrics::boundedMetrics());
        for (const auto& [truth, frame] : askedTruths(scene))
            EXPECT_TRUE(committedContents().contains(groundtruth::key(referenceRequest(scene, truth, frame))))
                << id << " " << name(truth) << " frame " << frame;
    }
}

/// A golden reference with a pixel that is not its own, and a checksum that is right.
TEST(GoldenContents, AreWhatCacheVerifyHoldsEntriesTo) {
    const Folder folder;
    const Scene scene = loadScene("dueling-frusta", Profile::Gate, metrics::boundedMetrics());
    const int frame = scene.timeline.still - 1;
    groundtruth::Reference wrong = groundtruth::readGolden(committed / "dueling-frusta-pixel-area.exr");
    wrong.position = Image<glm::vec3>(scene.size.x, scene.size.y);
    const groundtruth::Request request = referenceRequest(scene, Truth::PixelArea, frame);
    wrong.provenance.key = groundtruth::key(request);
    wrong.provenance.sources = groundtruth::sourcesOf(request);
    const groundtruth::Cache cache(folder / "cache");
    const std::string verify = "shadowbench cache verify --cache " + folder / "cache";
    cache.store(wrong);
    EXPECT_EQ(shell(verify).code, 0) << "as committed";
    wrong.visibility(100, 200) = 1 - wrong.visibility(100, 200);
    cache.store(wrong);
    const Outcome outcome = shell(verify);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.output.find("the pixel-area truth of dueling-frusta frame 59 is not the golden one"),
              std::string::npos)
        << outcome.output;
}

TEST(GoldenContents, ARunAgainstAWrongTruthInTheCacheEndsAsInconclusive) {
    const Folder folder;
    const Scene scene = loadScene("simple", Profile::Gate, metrics::boundedMetrics());
    const groundtruth::Cache cache(folder / "cache");
    groundtruth::Reference wrong =
        groundtruth::cached(cache, referenceRequest(scene, Truth::Hard, scene.timeline.still - 1));
    for (int x = 100; x < 110; ++x) wrong.visibility(x, 200) = 1 - wrong.visibility(x, 200);
    cache.store(wrong);
    const Outcome outcome = shell("shadowbench run --quiet --scene simple --technique none --cost none --cache " +
                                  folder / "cache" + " --out " + folder / "out");
    EXPECT_EQ(outcome.code, 5) << outcome.output;
    EXPECT_NE(outcome.output.find("the hard truth of simple frame 59 is not the golden one"), std::string::npos)
        << outcome.output;
}

/// Those that take a second each; the soft ones take POV-Ray a minute, pixel areas under trees some seconds.
TEST(GoldenReferences, HardOnesAreStillComputedBitForBit) {
    const Outcome outcome = shell("shadowbench reference --verify --quiet --truth hard --golden " + committed.string());
    EXPECT_EQ(outcome.code, 0) << outcome.output;
}

TEST(GoldenReferences, PixelAreasAreStillComputedBitForBit) {
    const Outcome outcome = shell(
        "shadowbench reference --verify --quiet --truth pixel-area --scene dueling-frusta --golden " + committed.string());
    EXPECT_EQ(outcome.code, 0) << outcome.output;
}

class GoldenVerb : public testing::Test {
protected:
    Outcome reference(const std::string& options) const {
        return shell("shadowbench reference --quiet --scene " + scene_ + " --golden " + folder_ / "golden" + " " + options);
    }
    void moveTheBox() const {
        std::string text = tinyScene();
        const std::string from = "[0.13, 1.2, 0.21]";
        text.replace(text.find(from), from.size(), "[0.16, 1.2, 0.21]");
        (void)folder_.write("tiny.toml", text);
    }
    /// Replaces the first `from` in the lock.
    void edit(const std::string& from, const std::string& to) const {
        std::string lock = readFile(folder_ / "golden/lock.json");
        ASSERT_NE(lock.find(from), std::string::npos);
        writeFile(folder_ / "golden/lock.json", lock.replace(lock.find(from), from.size(), to));
    }
    [[nodiscard]] std::string firstHash() const { return readLock(folder_ / "golden").entries.front().hashes.visibility; }

    Folder folder_;
    std::string scene_ = folder_.write("tiny.toml", tinyScene());
};

TEST_F(GoldenVerb, AcceptedReferencesVerify) {
    EXPECT_EQ(reference("--verify").code, 2) << "there is no lock yet";
    const Outcome accepted = reference("--accept");
    EXPECT_EQ(accepted.code, 0) << accepted.output;
    EXPECT_NE(accepted.output.find("tiny hard frame 2: new"), std::string::npos) << accepted.output;
    EXPECT_TRUE(fs::exists(folder_ / "golden/tiny-hard.exr"));
    const Outcome verified = reference("--verify");
    EXPECT_EQ(verified.code, 0) << verified.output;
    EXPECT_NE(verified.output.find("4 identical"), std::string::npos) << verified.output;
}

TEST_F(GoldenVerb, AcceptingTheSameAgainChangesNoByte) {
    reference("--accept");
    const std::string lock = readFile(folder_ / "golden/lock.json"), image = readFile(folder_ / "golden/tiny-hard.exr");
    EXPECT_EQ(reference("--accept").code, 0);
    EXPECT_EQ(readFile(folder_ / "golden/lock.json"), lock);
    EXPECT_EQ(readFile(folder_ / "golden/tiny-hard.exr"), image);
}

TEST_F(GoldenVerb, AChangedTruthIsReportedInPixelsAndReplacedByAcceptOnly) {
    reference("--accept");
    const std::string before = readFile(folder_ / "golden/lock.json");
    moveTheBox();
    const Outcome verified = reference("--verify");
    EXPECT_EQ(verified.code, 4) << verified.output;
    for (const char* part : {"tiny hard frame 2: changed: ", " labels, ", "visibility of ", "by up to 1,",
                             "edge distance of ", "tiny hard frame 3: changed: visibility, ", "--accept"})
        EXPECT_NE(verified.output.find(part), std::string::npos) << part << " in " << verified.output;
    EXPECT_EQ(readFile(folder_ / "golden/lock.json"), before);

    const Outcome accepted = reference("--accept");
    EXPECT_EQ(accepted.code, 0);
    EXPECT_NE(accepted.output.find("tiny hard frame 2: changed: "), std::string::npos) << accepted.output;
    EXPECT_EQ(reference("--verify").code, 0);
}

TEST_F(GoldenVerb, AChangedLockIsDetected) {
    reference("--accept");
    const std::string hash = firstHash();
    std::string other = hash;
    other[0] = other[0] == '0' ? '1' : '0';
    edit(hash, other);
    const Outcome verified = reference("--verify");
    EXPECT_EQ(verified.code, 4);
    EXPECT_NE(verified.output.find("3 identical, 1 changed"), std::string::npos) << verified.output;
    const auto json = nlohmann::json::parse(reference("--verify --json").output);
    EXPECT_EQ(json[0]["status"], "changed");
    EXPECT_EQ(json[1]["status"], "identical");
}

TEST_F(GoldenVerb, ADamagedImageIsDetected) {
    reference("--accept");
    const groundtruth::Reference moved = [&] {
        groundtruth::Reference image = groundtruth::readGolden(folder_ / "golden/tiny-hard.exr");
        image.visibility[100] = 0.5F;
        return image;
    }();
    writeGolden(moved, folder_ / "golden/tiny-hard.exr");
    const Outcome verified = reference("--verify");
    EXPECT_EQ(verified.code, 4);
    EXPECT_NE(verified.output.find("tiny-hard.exr does not hold"), std::string::npos) << verified.output;
}

TEST_F(GoldenVerb, OtherToolsThatGiveTheSameImagesAreANote) {
    reference("--accept");
    edit("\"cgal\": \"", "\"cgal\": \"0.");
    const Outcome verified = reference("--verify");
    EXPECT_EQ(verified.code, 0) << verified.output;
    EXPECT_NE(verified.output.find("identical; made otherwise: cgal 0."), std::string::npos) << verified.output;
}

TEST_F(GoldenVerb, AMissingToolIsInconclusiveAndTheOthersAreVerifiedAllTheSame) {
    scene_ = folder_.write("area.toml",
                           tinyScene("{ kind = \"rectangle\", centre = [0.2, 6, 0.3], u = [1, 0, 0], v = [0, 0, 1] }"));
    ASSERT_EQ(reference("--accept --truth hard").code, 0);
    ASSERT_EQ(reference("--accept --truth pixel-area").code, 0);
    ASSERT_EQ(reference("--accept --truth area").code, 0);
    const Outcome verified = shell("PATH=/nonexistent shadowbench reference --quiet --verify --scene " + scene_ +
                                   " --golden " + folder_ / "golden");
    EXPECT_EQ(verified.code, 5) << verified.output;
    EXPECT_NE(verified.output.find("5 identical, 2 unverified"), std::string::npos) << verified.output;
    EXPECT_NE(verified.output.find("apt-get install povray"), std::string::npos) << verified.output;
}

TEST_F(GoldenVerb, AFrameThatNoRunAsksForIsGone) {
    reference("--accept");
    edit("\"frame\": 3", "\"frame\": 7");
    const Outcome verified = reference("--verify");
    EXPECT_EQ(verified.code, 4);
    EXPECT_NE(verified.output.find("frame 7: gone"), std::string::npos) << verified.output;
    EXPECT_NE(verified.output.find("frame 3: new"), std::string::npos) << verified.output;
    reference("--accept");
    EXPECT_EQ(reference("--verify").code, 0);
}

TEST_F(GoldenVerb, AnInvalidLockFileIsNamed) {
    reference("--accept");
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"\"tiny-hard.exr\"", "\"../tiny-hard.exr\""}, {"\"version\": 1", "\"version\": 9"}, {"{", ""}}) {
        edit(from, to);
        const Outcome verified = reference("--verify");
        EXPECT_EQ(verified.code, 2) << from;
        EXPECT_NE(verified.output.find("lock.json is no lock file"), std::string::npos) << verified.output;
    }
}

TEST(TruthReport, IsWrittenOfAnySceneWithItsPictures) {
    const Folder folder;
    const std::string scene = folder.write("tiny.toml", tinyScene());
    const Outcome outcome = shell("shadowbench reference --quiet --scene " + scene + " --report " + folder / "truth" +
                                  " --cache " + folder / "cache");
    EXPECT_EQ(outcome.code, 0) << outcome.output;
    for (const char* file : {"report.md", "tiny.md", "tiny-hard-visibility.png", "tiny-hard-edge-distance.png",
                             "tiny-histograms.svg", "seconds.svg"})
        EXPECT_TRUE(fs::exists(folder / (std::string("truth/") + file))) << file;
    EXPECT_NE(readFile(folder / "truth/report.md").find("polygon, rays: 0 of "), std::string::npos);
}

} // namespace
} // namespace shadowbench
