#include "base/error.h"
#include "base/files.h"
#include "tools/faults/sandbox.h"

#include <algorithm>

namespace shadowbench::faults {

std::vector<Verb> writingVerbs() {
    const std::vector<std::string> plain{"--quiet", "--cost", "none", "--cache", "cache"};
    const auto words = [&](std::vector<std::string> first, const std::vector<std::string>& more) {
        first.insert(first.end(), more.begin(), more.end());
        return first;
    };
    return {
        {.name = "run",
         .arguments = words({"run", "--resume", "--jobs", "1", "--scene", "point.toml", "--technique", "pcf", "--technique",
                             "sm-uniform", "--technique", "volume-zfail", "--out", "half"},
                            plain),
         .out = "half",
         .records = "half/results.jsonl",
         .keeps = {"pcf"}},
        {.name = "gate",
         .arguments = words({"gate", "--same-program", "--scene", "point.toml", "--technique", "pcf", "--base",
                             "base/results.jsonl", "--bounds", "bounds.toml", "--out", "gate", "--junit", "gate/junit.xml"},
                            plain),
         .out = "gate",
         .records = "",
         .keeps = {}},
        {.name = "reference",
         .arguments = {"reference", "--quiet", "--scene", "point.toml", "--out", "reference"},
         .out = "reference",
         .records = "",
         .keeps = {}},
        {.name = "merge",
         .arguments = {"merge", "parts", "--out", "merged"},
         .out = "merged",
         .records = "merged/results.jsonl",
         .keeps = {}},
        {.name = "score",
         .arguments = {"score", "--quiet", "--scene", "point.toml", "--image", "base/images/point/pcf/visibility.exr",
                       "--definition", "hard", "--name", "mine", "--out", "rows", "--cache", "cache"},
         .out = "rows",
         .records = "rows/results.jsonl",
         .keeps = {"external:earlier"}},
        {.name = "report",
         .arguments = {"report", "base/results.jsonl", "--out", "report"},
         .out = "report",
         .records = "report/results.jsonl",
         .keeps = {}},
        {.name = "shard",
         .arguments = words({"run", "--scene", "area.toml", "--technique", "pcss", "--technique", "none", "--shard", "1/1",
                             "--out", "shard"},
                            plain),
         .out = "shard",
         .records = "",
         .keeps = {}},
        {.name = "soft run",
         .arguments = words({"run", "--resume", "--jobs", "2", "--scene", "area.toml", "--technique", "pcss", "--technique",
                             "none", "--out", "soft"},
                            plain),
         .out = "soft",
         .records = "soft/results.jsonl",
         .keeps = {}},
        {.name = "export",
         .arguments = {"export", "point.toml", "--quiet", "--out", "exported"},
         .out = "exported",
         .records = "",
         .keeps = {}},
        {.name = "sweep",
         .arguments = {"sweep", "--quiet", "--scene", "point.toml", "--axis", "map", "--values", "256,64", "--technique",
                       "sm-uniform", "--out", "sweep", "--cache", "cache"},
         .out = "sweep",
         .records = "sweep/sweep.jsonl",
         .keeps = {}},
        {.name = "recommend",
         .arguments = {"recommend", "--quiet", "--scene", "point.toml", "--what", "map", "--technique", "sm-uniform",
                       "--tolerance", "mismatch=0.2", "--out", "recommended", "--cache", "cache"},
         .out = "recommended",
         .records = "recommended/map/results.jsonl",
         .keeps = {}},
    };
}

std::vector<Verb> verbsNamed(const std::vector<std::string>& names) {
    const std::vector<Verb> all = writingVerbs();
    if (names.empty()) return all;
    std::vector<std::string> known;
    for (const Verb& verb : all) known.push_back(verb.name);
    std::vector<Verb> chosen;
    for (const std::string& name : names) {
        const auto found = std::ranges::find(all, name, &Verb::name);
        if (found == all.end()) throw BadInput("there is no verb \"" + name + "\" that writes" + didYouMean(name, known));
        chosen.push_back(*found);
    }
    return chosen;
}

} // namespace shadowbench::faults
