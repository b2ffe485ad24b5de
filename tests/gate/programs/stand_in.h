// A stand-in for a build of shadowbench: a shell script that answers as one does, with records that the test has made.
#pragma once

#include "base/files.h"
#include "gate/policy.h"
#include "harness/records/record.h"
#include "tests/support/records_examples.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::gate {

constexpr const char* pointLight = "{ kind = \"point\", centre = [1.7, 6.1, -2.3] }";
constexpr const char* areaLight = "{ kind = \"rectangle\", centre = [1.7, 6.1, -2.3], u = [0.9, 0, 0], v = [0, 0, 0.9] }";

/// A scene; its id is its file's name.
inline std::string standInScene(const std::string& light = pointLight) {
    return "# A box over a slab.\ntitle = \"Tiny\"\nsize = [32, 32]\nreference_samples = 16\n"
           "camera = { eye = [2.1, 6.2, 7.3], target = [0.1, 0, 0.2], fovy = 45, near = 0.5, far = 40 }\nlight = " +
           light +
           "\n[timeline]\nstill = 2\nmoving = 1\n"
           "[[object]]\nmesh = { box = { size = [12, 0.2, 12] } }\nplace = [{ at = [0, -0.1, 0] }]\n"
           "[[object]]\nmesh = { box = { size = [1.6, 0.4, 1.2] } }\nplace = [{ at = [0.13, 1.2, 0.21] }]\n";
}

/// A scored record of the scene "tiny".
inline Record standInRecord(const std::string& variant, std::uint32_t seed = 1) {
    Record record = test::hardRecord();
    record.scene = "tiny";
    record.technique = record.variant = variant;
    record.parameters.clear();
    record.seed = seed;
    return record;
}

class StandIn {
public:
    /// Two of different names are different programs.
    StandIn(const std::filesystem::path& folder, const std::string& name) : folder_(folder / name) {
        writeFile(program(), "#!/bin/sh\n# " + name + R"sh(
here=$(dirname "$0")
echo "$*" >>"$here/calls"
if [ -e "$here/$1.sh" ]; then . "$here/$1.sh"; fi
case $1 in
policy) cat "$here/identity.json"; exit ;;
list) cat "$here/$2.json"; exit ;;
esac
verb=$1
while [ $# -gt 0 ]; do
    case $1 in
    --out) out=$2 ;;
    --scene) scene=$(basename "$2" .toml) ;;
    --seed) seed=$2 ;;
    --images) images=yes ;;
    --shard) part=yes ;;
    --technique) printf '"variant":"%s",\n' "$2" >>variants; [ -z "${images-}" ] || echo "$2" >>drawn ;;
    esac
    shift
done
echo "tiny 1/3  pcf"
mkdir -p "$out"
for variant in $(cat drawn 2>/dev/null); do
    folder=$out/images/$scene/$(echo "$variant" | tr : _)
    mkdir -p "$folder"
    echo >"$folder/visibility.png"
done
of_scene() { grep -F "\"scene\":\"$scene\"," "$here/records.jsonl" | grep -F "\"seed\":$seed,"; }
of_run() { of_scene | grep -vF '"sweep":' | grep -F -f variants; }
if [ "$verb" = sweep ]; then of_scene | grep -F '"sweep":' >"$out/sweep.jsonl"
elif [ -n "${part-}" ]; then
    mkdir -p "$out/cells"
    i=0
    of_run | while read -r record; do
        i=$((i + 1))
        echo "{\"id\":\"$i\",\"exit_code\":0,\"record\":$record}" >"$out/cells/$i.json"
    done
else of_run >"$out/results.jsonl"; fi
exit "$(cat "$here/code")"
)sh");
        std::filesystem::permissions(program(), std::filesystem::perms::owner_all);
        is({name + "0123456789abcdef", false, name, {}});
        lists("scenes", R"([{"id": "simple"}])");
        lists("techniques", R"([{"id": "pcf", "variants": [""], "parameters": [{"name": "map", "values": "16…8192"},)"
                            R"({"name": "kernel", "values": "3|5"}]},)"
                            R"({"id": "none", "variants": [""], "parameters": []}])");
        endsWith(0);
        measures({standInRecord("pcf")});
    }

    [[nodiscard]] std::filesystem::path program() const { return folder_ / "shadowbench"; }

    // What it answers from now on.
    void is(const BuildInfo& build) const { writeFile(folder_ / "identity.json", toJson(build)); }
    void lists(const std::string& what, const std::string& json) const { writeFile(folder_ / (what + ".json"), json); }
    void measures(const std::vector<Record>& records) const { writeRecords(folder_ / "records.jsonl", records); }
    void endsWith(int code) const { writeFile(folder_ / "code", std::to_string(code)); }
    /// A shell's commands that come before what it does of itself.
    void does(const std::string& verb, const std::string& commands) const { writeFile(folder_ / (verb + ".sh"), commands); }
    /// So many milliseconds a frame.
    void takes(const std::string& cpu, const std::string& wall) const {
        does("time-frames", "i=0\nwhile read -r count variant; do\n[ $count = 0 ] || i=$((i + 1))\necho $((count * (" + cpu +
                                "))) $((count * (" + wall + ")))\ndone\nexit\n");
    }

    /// How often it was called with this word first.
    [[nodiscard]] std::ptrdiff_t calls(const std::string& verb) const {
        if (!std::filesystem::exists(folder_ / "calls")) return 0;
        std::ptrdiff_t count = 0;
        const std::string lines = "\n" + readFile(folder_ / "calls"), line = "\n" + verb + " ";
        for (std::size_t at = lines.find(line); at != std::string::npos; at = lines.find(line, at + 1)) ++count;
        return count;
    }

private:
    std::filesystem::path folder_;
};

} // namespace shadowbench::gate
