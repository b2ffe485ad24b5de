// What is run in the sandbox.
#include "tools/faults/sandbox.h"

#include <algorithm>

namespace shadowbench::faults {

std::vector<Verb> verbsNamed(const std::vector<std::string>& names) {
    const std::string point = " --scene point.toml --quiet --cache cache --cost none",
                      area = " --scene area.toml --quiet --cache cache --cost none --technique none --technique pcss",
                      one = " --scene point.toml --quiet --cache cache --technique sm-uniform";
    const std::vector<Verb> all{
        {"run",
         "run --resume --jobs 1 --technique pcf --technique sm-uniform --technique volume-zfail" + point + " --out half"},
        {"gate",
         "gate --same-program --technique pcf --base base/results.jsonl --bounds bounds.toml --junit gate/junit.xml" +
             point + " --out gate"},
        {"reference", "reference --quiet --scene point.toml --out reference"},
        {"merge", "merge parts --out merged"},
        {"score", "score --quiet --scene point.toml --image base/images/point/pcf/visibility.exr --definition hard "
                  "--name mine --cache cache --out rows"},
        {"report", "report base/results.jsonl --out report"},
        {"shard", "run --shard 1/1" + area + " --out shard"},
        {"soft run", "run --resume --jobs 2" + area + " --out soft"},
        {"export", "export point.toml --quiet --out exported"},
        {"sweep", "sweep --axis map --values 256,64" + one + " --out sweep"},
        {"recommend", "recommend --what map --tolerance mismatch=0.2" + one + " --out recommended"}};
    std::vector<Verb> chosen;
    std::ranges::copy_if(all, std::back_inserter(chosen), [&](const Verb& verb) {
        return names.empty() || std::ranges::find(names, verb.name) != names.end();
    });
    return chosen;
}

} // namespace shadowbench::faults
