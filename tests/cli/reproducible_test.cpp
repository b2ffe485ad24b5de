// What must not change images, truths and records, does not: docs/reproducible.md.
#include "base/files.h"
#include "base/hash.h"
#include "harness/records/record.h"
#include "harness/runs/merge.h"
#include "tests/support/program.h"

#include <gtest/gtest.h>
#include <map>
#include <set>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

class Reproducible : public testing::Test {
protected:
    /// Runs `command` with the scenes and a cache of its own in the folder `place`; `options` come in the order given.
    void run(const std::string& environment, const std::string& place, const std::string& options) const {
        fs::create_directories(folder_ / place);
        folder_.write(place + "/point.toml", tinyScene());
        folder_.write(place + "/disk.toml",
                      tinyScene("{ kind = \"disk\", centre = [1.7, 6.1, -2.3], u = [1.4, 0, 0.1], v = [-0.1, 0, 1.4] }"));
        const Outcome outcome = shell("cd '" + (folder_ / place) + "' && " + environment + " shadowbench run --quiet " +
                                      options + " --cost none --images --cache cache --out out");
        ASSERT_EQ(outcome.code, 0) << outcome.output;
    }

    /// Each record without times, whatever their order.
    [[nodiscard]] std::set<std::string> records(const std::string& place) const {
        std::set<std::string> lines;
        for (const Record& record : readRecords(folder_ / (place + "/out/results.jsonl")))
            lines.insert(toJson(shards::withoutTimings(record)));
        return lines;
    }

    /// Each picture's hash, by its name.
    [[nodiscard]] std::map<std::string, std::string> pictures(const std::string& place) const {
        std::map<std::string, std::string> hashes;
        const fs::path images = folder_ / (place + "/out/images");
        for (const auto& file : fs::recursive_directory_iterator(images))
            if (file.is_regular_file())
                hashes[file.path().lexically_relative(images)] = hash128(readFile(file.path())).text();
        return hashes;
    }

    void expectTheSame(const std::string& place) const {
        EXPECT_EQ(records(place), records("first")) << place;
        EXPECT_EQ(pictures(place), pictures("first")) << place;
        EXPECT_GT(pictures(place).size(), 20U);
    }

    /// A locale that writes a comma where a number has its point; "" where none can be made.
    [[nodiscard]] std::string commaLocale() const {
        const std::string folder = folder_ / "locales";
        fs::create_directories(folder);
        if (shell("localedef -i de_DE -f UTF-8 '" + folder + "/de_DE.UTF-8'").code != 0) return "";
        const std::string locale = "LOCPATH='" + folder + "' LC_ALL=de_DE.UTF-8 LANG=de_DE.UTF-8 LC_NUMERIC=de_DE.UTF-8";
        EXPECT_EQ(shell(locale + " locale decimal_point").output, ",\n");
        return locale;
    }

    static constexpr const char* forward =
        "--jobs 2 --scene point.toml --scene disk.toml --technique sm-uniform --technique pcss --technique sm-history";
    static constexpr const char* backward =
        "--technique sm-history --technique pcss --technique sm-uniform --scene disk.toml --scene ./point.toml --jobs 1";
    Folder folder_;
};

TEST_F(Reproducible, NeitherLocaleNorZoneNorCoresNorFoldersNorVariablesNorTheOrderOfOptionsCount) {
    run("", "first", forward);
    // Memory that malloc gives is not zero: what is read before it is written shows.
    const std::string place = "Prüfung 2, 50 %";
    run("env -i PATH=/usr/bin:/bin TZ=Pacific/Kiritimati HOME=/nowhere COLUMNS=20 OMP_NUM_THREADS=7 MALLOC_PERTURB_=165 " +
            commaLocale() + " taskset -c 0",
        place, backward);
    expectTheSame(place);
}

} // namespace
} // namespace shadowbench
